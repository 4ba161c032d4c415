"""Every kind of error has a code of its own, a status, a page that explains it, and something to do."""

import re

import pytest

from service.api.problem_pages import ADVICE, error_classes
from service.api.problems import STATUS, status_of
from service.core.errors import ServiceError
from tests.plant import Plant

KINDS = error_classes()


def test_there_are_errors_to_check() -> None:
    assert len(KINDS) > 30


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.code)
def test_an_error_has_a_status_and_advice(kind: type[ServiceError]) -> None:
    assert 400 <= status_of(kind) <= 503
    assert any(parent in ADVICE for parent in kind.__mro__)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.code)
def test_an_error_has_a_code_a_title_and_a_docstring_of_its_own(kind: type[ServiceError]) -> None:
    assert re.fullmatch(r"[a-z]+(-[a-z]+)*", kind.code)
    assert "code" in vars(kind)
    assert "title" in vars(kind)
    assert kind.__doc__


def test_no_two_errors_share_a_code() -> None:
    codes = [kind.code for kind in KINDS]

    assert len(codes) == len(set(codes))


def test_only_faults_and_absences_are_5xx() -> None:
    assert {kind.__name__ for kind, status in STATUS.items() if status >= 500} == {
        "InternalError",
        "Unavailable",
    }


def test_every_error_has_a_page_that_needs_no_key(small_plant: Plant) -> None:
    overview = small_plant.client.get("/problems").text

    for kind in KINDS:
        page = small_plant.client.get(f"/problems/{kind.code}")
        assert page.status_code == 200
        assert kind.code in page.text
        assert "What to do" in page.text
        assert f"/problems/{kind.code}" in overview
