"""A service for one test alone, with an administrator who asks it. Not here: the shared one (`conftest`)."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from service.demo.customer import Customer
from tests.browser.chromium import find_chromium
from tests.browser.serving import Serving, prepare_service


@dataclass(frozen=True)
class OwnService:
    """The running service and its administrator."""

    serving: Serving
    customer: Customer

    def key_of(self, role: str) -> str:
        """A new key of a role."""
        return str(self.customer.ask("POST", "/keys", json={"name": role, "role": role})["key"])


@contextmanager
def own_service(folder: Path) -> Iterator[OwnService]:
    """Serve from a folder; skips where there is no browser, before anything is started."""
    find_chromium()
    serving = prepare_service(folder)
    serving.start()
    try:
        customer = Customer.of(serving.url, serving.key)
        with customer.http:
            yield OwnService(serving, customer)
    finally:
        serving.stop()
