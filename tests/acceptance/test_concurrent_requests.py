"""Many requests at once: more writers than a server has threads by default, and each is answered."""

from concurrent.futures import ThreadPoolExecutor

from tests.plant import Plant

# The server's default is 40 threads.
AT_ONCE = 80


def test_more_writers_at_once_than_threads_by_default_are_all_answered(plant: Plant) -> None:
    def create(number: int) -> int:
        return plant.post("/stations", {"code": f"st{number}", "name": "Station"}).status_code

    with ThreadPoolExecutor(AT_ONCE) as threads:
        answers = list(threads.map(create, range(2 * AT_ONCE)))

    assert answers == [201] * (2 * AT_ONCE)
