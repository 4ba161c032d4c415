"""The binary block for a camera's memory, by the layout of the SKU's revision."""

from functools import partial

from service.usecases.block_codec import encode_block
from service.usecases.block_layout import BlockLayout
from service.usecases.block_sources import value_of
from service.usecases.exports.format import Format
from service.usecases.finished_run import FinishedRun
from service.usecases.result_problems import BlockLayoutUnusable


def write(run: FinishedRun) -> bytes:
    """Return the block by the SKU's layout; raises BlockLayoutUnusable."""
    return write_by(run, layout_of(run, None))


def write_by(run: FinishedRun, layout: BlockLayout) -> bytes:
    """Return the block by a layout; raises BlockLayoutUnusable."""
    return encode_block(layout, partial(value_of, run, layout))


def layout_of(run: FinishedRun, given: BlockLayout | None) -> BlockLayout:
    """Return the layout that was given, else the SKU's; raises BlockLayoutUnusable where there is none."""
    layout = given or run.sku.block_layout
    if layout is None:
        raise BlockLayoutUnusable(
            f"SKU '{run.facts.sku}', revision {run.facts.revision}, has no block_layout. Give a layout with "
            "the request, or add one to a new revision of the SKU.",
            sku=run.facts.sku,
            revision=run.facts.revision,
        )
    return layout


FORMAT = Format("block", "Binary block", "application/octet-stream", "bin", write)
