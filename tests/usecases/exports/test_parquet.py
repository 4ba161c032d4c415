"""Parquet is read by Arrow's own reader, with its types, and many runs are written in groups."""

import io
from collections.abc import Iterator

import pyarrow.parquet as pq
import pytest

from service.core.quality.gates import Verdict
from service.usecases.exports import parquet
from service.usecases.exports.long_table import rows_of
from service.usecases.finished_run import RunFacts
from tests.finished import finished_run


def test_a_run_is_read_back_with_its_types_and_every_digit() -> None:
    run = finished_run(verdict=Verdict.FAIL)
    table = pq.read_table(io.BytesIO(parquet.write(run)))

    assert table.schema.field("finished_at").type == parquet.SCHEMA.field("finished_at").type
    rows = table.to_pylist()
    assert [row["name"] for row in rows] == [row.name for row in rows_of(run.facts)]
    assert {row["verdict"] for row in rows} == {"FAIL"}
    assert {row["finished_at"] for row in rows} == {run.facts.finished_at}
    parameters = {row["name"]: row["value"] for row in rows if row["kind"] == "parameter"}
    assert parameters == run.facts.intrinsics.parameters
    (score,) = [row for row in rows if row["name"] == "paper_score"]
    assert (score["value"], score["limit"], score["comparison"]) == (None, None, None)


def test_many_runs_are_written_in_groups(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parquet, "ROWS_AT_ONCE", 40)
    each = len(list(rows_of(finished_run().facts)))

    def runs() -> Iterator[RunFacts]:
        for number in range(7):
            yield finished_run(serial=f"VIN-{number}").facts

    file = pq.ParquetFile(io.BytesIO(parquet.write_many(runs())))

    assert file.metadata.num_rows == 7 * each
    assert file.metadata.num_row_groups > 2
    serials = file.read(["serial"]).column("serial").to_pylist()
    assert serials == [f"VIN-{number}" for number in range(7) for _ in range(each)]


def test_no_runs_are_an_empty_table_with_the_same_columns() -> None:
    table = pq.read_table(io.BytesIO(parquet.write_many([])))

    assert (table.num_rows, table.column_names) == (0, parquet.SCHEMA.names)
