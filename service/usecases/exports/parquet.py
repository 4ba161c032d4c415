"""Apache Parquet: the long table with its types, for pandas, Polars, DuckDB, Spark and their like."""

from collections.abc import Iterable
from dataclasses import asdict
from io import BytesIO
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from service.usecases.exports.format import Format
from service.usecases.exports.long_table import rows_of
from service.usecases.finished_run import FinishedRun, RunFacts

# Of one group: only these are held as rows, what is written is compressed.
ROWS_AT_ONCE = 10_000

WORD = pa.dictionary(pa.int32(), pa.string())
SCHEMA = pa.schema(
    [
        pa.field("run_id", pa.string(), nullable=False),
        pa.field("serial", pa.string(), nullable=False),
        pa.field("sku", WORD, nullable=False),
        pa.field("revision", pa.int32(), nullable=False),
        pa.field("station", WORD),
        pa.field("purpose", WORD, nullable=False),
        pa.field("finished_at", pa.timestamp("us", tz="UTC"), nullable=False),
        pa.field("verdict", WORD, nullable=False),
        pa.field("lens", WORD, nullable=False),
        pa.field("kind", WORD, nullable=False),
        pa.field("gate", WORD),
        pa.field("name", WORD, nullable=False),
        pa.field("value", pa.float64()),
        pa.field("sd", pa.float64()),
        pa.field("unit", WORD, nullable=False),
        pa.field("comparison", WORD),
        pa.field("limit", pa.float64()),
        pa.field("margin", pa.float64()),
        pa.field("measured_verdict", WORD),
    ]
)


def write(run: FinishedRun) -> bytes:
    """Return the file of one run."""
    return write_many([run.facts])


def write_many(runs: Iterable[RunFacts]) -> bytes:
    """Return the file of many runs."""
    out = BytesIO()
    with pq.ParquetWriter(out, SCHEMA, compression="zstd") as writer:
        waiting: list[dict[str, Any]] = []
        for run in runs:
            waiting += [asdict(row) for row in rows_of(run)]
            if len(waiting) >= ROWS_AT_ONCE:
                writer.write_table(pa.Table.from_pylist(waiting, schema=SCHEMA))
                waiting = []
        writer.write_table(pa.Table.from_pylist(waiting, schema=SCHEMA))
    return out.getvalue()


FORMAT = Format("parquet", "Parquet", "application/vnd.apache.parquet", "parquet", write, write_many)
