"""What the claims about speed and accuracy rest on: `python -m bench NAME [--quick] [--json FILE]`.

A bench is a module here with `run(quick: bool) -> dict[str, object]`, whose first keys are those of the
design's list of benches and which holds its `seeds`, and `table(result) -> str`. It may have
`plot(result, path)`, and `reuse(result)` where another bench's result will do. Not here: tests.
"""

import service  # noqa: F401 - before NumPy, whose threads it limits as in the service
