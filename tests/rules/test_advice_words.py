"""Whatever a gate can say, the pages say in each of their languages. Whole sentences: advice.test.ts."""

import re
from pathlib import Path

import pytest

from service.core.quality.reasons import Reason

WORDS = Path(__file__).resolve().parents[2] / "web" / "src" / "words"
# A code begins an entry; its sentences are indented further.
ENTRY = re.compile(r"^  (\w+): \{", re.MULTILINE)


@pytest.mark.parametrize("language", ["en", "de", "zh"])
def test_every_reason_has_its_sentences(language: str) -> None:
    found = ENTRY.findall((WORDS / f"advice_{language}.ts").read_text())

    assert sorted(found) == sorted(Reason)
