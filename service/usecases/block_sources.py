"""What a block's fields can hold: values of a finished run by their names, as docs/exports.md lists them."""

from collections.abc import Callable, Mapping
from typing import Final

from service.core.quality.gates import Verdict
from service.usecases.block_codec import Value
from service.usecases.block_layout import BlockLayout
from service.usecases.certificate import result_hash
from service.usecases.finished_run import FinishedRun
from service.usecases.result_problems import BlockLayoutUnusable

VERDICT_NUMBERS: Final = {Verdict.PASS: 0, Verdict.MARGINAL: 1, Verdict.FAIL: 2}

Read = Callable[[FinishedRun], Value]

SINGLE: Final[Mapping[str, Read]] = {
    "run.serial": lambda run: run.facts.serial,
    "run.id": lambda run: run.facts.run_id.bytes,
    "run.station": lambda run: run.facts.station or "",
    "run.purpose": lambda run: run.facts.purpose.value,
    "run.verdict": lambda run: run.facts.verdict.value,
    "run.verdict_number": lambda run: VERDICT_NUMBERS[run.facts.verdict],
    "run.finished_at": lambda run: int(run.facts.finished_at.timestamp()),
    "sku.code": lambda run: run.facts.sku,
    "sku.revision": lambda run: run.facts.revision,
    "image.width": lambda run: run.facts.intrinsics.image_size[0],
    "image.height": lambda run: run.facts.intrinsics.image_size[1],
    "lens.name": lambda run: run.facts.intrinsics.lens,
    "result.id": lambda run: run.facts.result_id.bytes,
    "result.sha256": lambda run: bytes.fromhex(result_hash(run.document)),
    "result.rms_px": lambda run: run.facts.rms_px,
    "result.sigma_px": lambda run: run.facts.sigma_px,
}
FAMILIES: Final[Mapping[str, Callable[[FinishedRun], Mapping[str, float | None]]]] = {
    "intrinsics": lambda run: run.facts.intrinsics.parameters,
    "sd": lambda run: run.facts.sd,
    "mapping": lambda run: run.document["mapping"],
    "extrinsics": lambda run: {} if run.place is None else run.place.values,
}


def value_of(run: FinishedRun, layout: BlockLayout, source: str) -> Value:
    """Return the value of a source; BlockLayoutUnusable for an unknown one or one without value."""
    if source in SINGLE:
        return SINGLE[source](run)
    if source in {"layout.version", "layout.size"}:
        return layout.version if source == "layout.version" else layout.size
    family, _, name = source.partition(".")
    values = FAMILIES[family](run) if family in FAMILIES else {}
    value = values.get(name)
    if value is None:
        if family == "extrinsics" and run.place is None:
            raise BlockLayoutUnusable(
                f"The layout asks for '{source}', and nobody measured where this camera is in its vehicle. "
                "Measure its extrinsics, or take a layout without them.",
                source=source,
            )
        known = [*SINGLE, "layout.version", "layout.size", *(f"{one}.NAME" for one in FAMILIES)]
        raise BlockLayoutUnusable(
            f"This result has no '{source}'; its lens is {run.facts.intrinsics.lens}. Sources are: "
            f"{', '.join(known)}.",
            source=source,
        )
    return value
