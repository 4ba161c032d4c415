"""The formats by their names. A new one is its file and one line here."""

from collections.abc import Mapping
from typing import Final

from service.usecases.exports import (
    binary_block,
    csv_file,
    kalibr,
    opencv,
    parquet,
    pdf_report,
    ros,
    stored_json,
)
from service.usecases.exports.format import Format

FORMATS: Final[Mapping[str, Format]] = {
    one.FORMAT.name: one.FORMAT
    for one in (opencv, ros, kalibr, binary_block, csv_file, parquet, pdf_report, stored_json)
}
