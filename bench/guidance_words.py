"""The figures of the bench `guidance` as lines of text. Not here: how they are measured."""

from collections.abc import Mapping
from typing import Any


def describe(row: Mapping[str, Any]) -> list[str]:
    """Return one camera's figures, a line for each claim."""
    alone, found, live = row["detection"], row["found"], row["live_renderer"]
    p95 = ", ".join(f"{name} {alone[name]['p95_ms']:.1f}" for name in ("first", "partial", "absent"))
    right = f"found {row['detection_rate']:.3f}, wrong {found['wrong']:.3f}, rms {found['rms_px']:.3f} px"
    alarms = f"false alarms {row['false_alarms']:.3f}, cut called whole {row['called_whole_though_cut']:.3f}"
    theirs = f"OpenCV: found {row['opencv_detection_rate']:.3f}, p95 {row['opencv_p95_ms']:.1f} ms"
    drawn = f"live renderer: {live['p50_ms']:.1f} ms, {live['frames_per_s']:.0f} frames/s of one core"
    return [
        f"detection alone, p95 ms: {p95}",
        f"{right}; {alarms}",
        f"{theirs} ({row['speedup_p95']:.1f} times), without a board {row['opencv_absent_p95_ms']:.1f} ms",
        *_random_words(row["random_poses"]),
        _empty_words(row["empty_frames"], row["real_negatives"]),
        *_condition_words(row["conditions"]),
        *_mixed_words(row["mixed"]),
        _corner_words(row["corner_error"]),
        f"{drawn}; decoding a JPEG: {row['decode_ms']:.1f} ms",
    ]


def _times(row: Mapping[str, Any]) -> str:
    return (
        f"p95 {row['p95_ms']:.1f} ms (CPU {row['cpu_p95_ms']:.1f}), max {row['max_ms']:.1f} ms (CPU "
        f"{row['cpu_max_ms']:.1f})"
    )


def _random_words(row: Mapping[str, Any]) -> list[str]:
    total = f"{row['boards']} random poses: found {row['rate']:.4f}, wrong {row['wrong']}, {_times(row)}"
    return [total, *_by_words(row["by"])]


def _empty_words(row: Mapping[str, Any], real: Mapping[str, Any]) -> str:
    photographs = f"photographs: false {real['false']} of {real['frames']}"
    return f"{row['frames']} empty frames: false {row['false']}, {_times(row)}; {photographs}"


def _mixed_words(row: Mapping[str, Any]) -> list[str]:
    lines = [
        f"  {name}: rate {row[name]['rate']:.3f}, false {row[name]['false']:.0f}, {_times(row[name])}"
        for name in ("ours", "to_state", "fast_check", "fast_check_half", "sb", "sb_half")
    ]
    faster = f"{row['speedup_p95']:.1f} times as fast as {row['best_of_opencv']}"
    by_cpu = f"CPU {row['speedup_cpu_p95']:.1f}, to the state {row['speedup_to_state_cpu_p95']:.1f}"
    return [f"mixed set of {row['frames']}: {faster} ({by_cpu})", *lines]


def _corner_words(row: Mapping[str, Any]) -> str:
    theirs = f"cornerSubPix {row['corner_sub_pix_rms_px']:.4f} px at window {row['best_window']}"
    return f"capture: rms {row['rms_px']:.4f} px, {theirs}: ratio {row['ratio']:.2f}"


def _by_words(by: Mapping[str, Any]) -> list[str]:
    return [
        f"  by {name}: "
        + ", ".join(
            f"{part['from']:g}-{part['to']:g} {part['rate']:.3f} of {part['boards']}" for part in rows
        )
        for name, rows in by.items()
    ]


def _condition_words(rows: Mapping[str, Any]) -> list[str]:
    return [
        f"  {name}: right {row['right']:.3f}, found {row['found']:.3f}, wrong {row['wrong']}, {_times(row)}"
        for name, row in rows.items()
    ]
