"""The page for integrators does what it says: its code runs as it stands against a real service."""

import os
import re
from pathlib import Path
from typing import Any

import pytest

from service.demo.server import running_service

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT.parent / "shared" / "data" / "opencv_left_right"


@pytest.mark.data
def test_the_code_on_the_integrators_page_runs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if not IMAGES.is_dir() and "CI" not in os.environ:
        pytest.skip(f"no real images at {IMAGES}")
    left = tmp_path / "left"
    left.mkdir()
    for image in sorted(IMAGES.glob("left*.jpg")):
        (left / image.name).symlink_to(image)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "integrating.md").read_text(), re.S)
    data_dir = tmp_path / "data"
    data_dir.mkdir()

    names: dict[str, Any] = {"IMAGES": str(left)}
    with running_service(data_dir, port=0) as service:
        names |= {"SERVICE": service.url, "KEY": service.key}
        try:
            exec(compile("\n".join(blocks), "docs/integrating.md", "exec"), names)  # noqa: S102 - our own page
        finally:
            names["api"].close()

    printed = capsys.readouterr().out
    assert "expected sd of fx" in printed
    assert "1 run(s); the last verdict" in printed
    assert names["result"]["rms_px"] < 0.175
