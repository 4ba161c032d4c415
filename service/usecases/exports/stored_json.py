"""The whole result as it is stored, with every residual, in canonical JSON.

The SHA-256 of this file is the one that the certificate names.
"""

from service.usecases.canonical_json import canonical_json
from service.usecases.exports.format import Format
from service.usecases.finished_run import FinishedRun


def write(run: FinishedRun) -> bytes:
    """Return the file."""
    return canonical_json(run.document)


FORMAT = Format("json", "JSON", "application/json", "json", write)
