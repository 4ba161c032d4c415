from pathlib import Path

import numpy as np
import pytest

from bench import browser
from bench.browser import summarise, table, write_film
from service.demo.skus import PAPER_SKUS


def test_the_rate_is_that_of_drawn_frames_and_the_age_that_since_they_were_grabbed() -> None:
    drawn = [(40.0 * i, 20.0 + i, "present" if i % 4 else "absent") for i in range(101)]
    row = summarise(drawn)
    assert row["frames_per_s"] == pytest.approx(25.0)
    assert (row["p50_ms"], row["max_ms"]) == (70.0, 120.0)
    assert row["present"] == pytest.approx(75 / 101)
    assert "25.0 frames/s" in table(row)


def test_the_film_is_what_a_browser_takes_for_a_camera(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(browser, "PICTURES", 2)
    content = write_film(PAPER_SKUS[0], tmp_path / "film.y4m").read_bytes()
    head, _, rest = content.partition(b"\n")
    assert head == b"YUV4MPEG2 W1280 H800 F30:1 Ip A1:1 C420jpeg"
    frames = np.frombuffer(rest, np.uint8).reshape(2, 6 + 1280 * 800 * 3 // 2)
    assert bytes(frames[1, :6]) == b"FRAME\n"
    assert np.ptp(frames[0, 6 : 6 + 1280 * 800]) > 100
