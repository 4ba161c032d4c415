"""Every route names the role that may use it, or says that it needs none."""

from collections.abc import Iterator

import pytest
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute, APIWebSocketRoute, iter_route_contexts

from service.api.application import create_api
from service.api.auth import RequireRole, SocketRoles, nobody
from service.storage.words import Role
from tests.plant import Plant, problem

# The whole list, so that a route becomes public only on purpose.
PUBLIC = {
    "/livez",
    "/readyz",
    "/.well-known/jwks.json",
    "/openapi.json",
    "/api/docs",
    "/problems",
    "/problems/{code}",
    "/",
    "/kiosk",
    "/{path:path}",
}
ROUTES = [
    (method, route.path, route.original_route.dependant)
    for route in iter_route_contexts(create_api().routes)
    for method in sorted(route.methods or ())
    if isinstance(route.original_route, APIRoute) and route.path is not None
]
SOCKETS = [
    (route.path, route.original_route.dependant)
    for route in iter_route_contexts(create_api().routes)
    if isinstance(route.original_route, APIWebSocketRoute)
]
# What changes the plant's set-up; operators only calibrate.
ENGINEERS = {"/skus", "/targets", "/stations", "/pose-sets", "/jobs", "/keys"}


def calls(dependant: Dependant) -> Iterator[object]:
    """Everything that a route depends on."""
    for dependency in dependant.dependencies:
        yield dependency.call
        yield from calls(dependency)


def role_of(dependant: Dependant) -> Role | None:
    """The role that a route names."""
    return next((call.role for call in calls(dependant) if isinstance(call, RequireRole)), None)


def test_every_route_names_a_role_or_is_listed_as_public() -> None:
    nameless = {path for _, path, dependant in ROUTES if role_of(dependant) is None}

    assert nameless <= PUBLIC
    assert len(ROUTES) > 30


@pytest.mark.parametrize("path", sorted(PUBLIC))
def test_a_public_route_says_so(path: str) -> None:
    marked = {
        route.path
        for route in iter_route_contexts(create_api().routes)
        if any(call is nobody for call in calls(route.dependant))
    }

    assert path in marked


@pytest.mark.parametrize(("method", "path", "dependant"), ROUTES, ids=lambda value: str(value)[:40])
def test_only_engineers_change_how_the_plant_works(method: str, path: str, dependant: Dependant) -> None:
    if method in {"POST", "DELETE"} and any(path.startswith(f"/api/v1{start}") for start in ENGINEERS):
        assert role_of(dependant) in {Role.ENGINEER, Role.ADMIN}


def test_every_socket_names_the_roles_of_kiosks_and_monitors() -> None:
    roles = {
        path: [call for call in calls(dependant) if isinstance(call, SocketRoles)]
        for path, dependant in SOCKETS
    }

    assert roles == {
        "/ws/v1/stations/{code}/guidance": [SocketRoles(kiosk=Role.OPERATOR, monitor=Role.VIEWER)]
    }


def test_without_a_key_nothing_is_answered(small_plant: Plant) -> None:
    for method, path, dependant in ROUTES:
        if role_of(dependant) is not None:
            problem(small_plant.client.request(method, path), 401, "not-authenticated")


def test_a_role_that_is_too_low_is_refused(small_plant: Plant) -> None:
    refused = problem(small_plant.post("/skus", {}, role=Role.OPERATOR), 403, "role-missing")

    assert refused["facts"] == {"role": "operator", "needed": "engineer"}
    problem(small_plant.post("/keys", {}, role=Role.ENGINEER), 403, "role-missing")
    problem(small_plant.post("/runs", {}, role=Role.VIEWER), 403, "role-missing")
    problem(small_plant.post("/runs", {}, role=Role.MES), 422, "validation-failed")
    assert small_plant.get("/runs", role=Role.MES).status_code == 200
