"""Who asks: from the API key of a request to a caller with a role, and the roles that routes name.

Roles rise viewer < operator < engineer < admin. `mes` is a viewer who may also open runs. What keys are and
how they are made stands in `service.usecases.access`.
"""

from dataclasses import dataclass
from typing import Annotated

from fastapi import Depends
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer

from service.api.dependencies import Now, Of
from service.core.errors import NotAllowed, NotAuthenticated
from service.storage.words import Role
from service.usecases.access import Caller, identify

ROLES_FROM = {
    Role.VIEWER: {Role.VIEWER, Role.MES, Role.OPERATOR, Role.ENGINEER, Role.ADMIN},
    Role.MES: {Role.MES, Role.OPERATOR, Role.ENGINEER, Role.ADMIN},
    Role.OPERATOR: {Role.OPERATOR, Role.ENGINEER, Role.ADMIN},
    Role.ENGINEER: {Role.ENGINEER, Role.ADMIN},
    Role.ADMIN: {Role.ADMIN},
}
bearer = HTTPBearer(auto_error=False, description="An API key: `Authorization: Bearer dmscal_…`.")


@dataclass(frozen=True)
class RequireRole:
    """The dependency by which a route says the least role that may use it."""

    role: Role

    def __call__(
        self, key: Annotated[HTTPAuthorizationCredentials | None, Depends(bearer)], of: Of, now: Now
    ) -> Caller:
        """Return the caller.

        Raises NotAuthenticated without a valid key, NotAllowed when the role is too low.
        """
        if key is None:
            raise NotAuthenticated("Send your API key in the header 'Authorization: Bearer dmscal_…'.")
        caller = identify(of.database, key.credentials, now)
        check_role(caller, self.role)
        return caller


@dataclass(frozen=True)
class SocketRoles:
    """The dependency by which a socket says the least role of a kiosk and of a monitor.

    A browser cannot send a header with a socket: the key comes in its first message.
    """

    kiosk: Role
    monitor: Role

    def __call__(self) -> "SocketRoles":
        """Return itself, for the socket to check its clients with."""
        return self


def check_role(caller: Caller, needed: Role) -> None:
    """Raise NotAllowed when a caller's role is too low."""
    if caller.role not in ROLES_FROM[needed]:
        raise NotAllowed(
            f"Key '{caller.name}' has the role {caller.role}; this needs {needed}. Ask for another key.",
            role=caller.role.value,
            needed=needed.value,
        )


def nobody() -> None:
    """Mark a route that needs no key: health, documentation and the pages of the web interface."""


PUBLIC = Depends(nobody)
Guides = Annotated[SocketRoles, Depends(SocketRoles(kiosk=Role.OPERATOR, monitor=Role.VIEWER))]
Viewer = Annotated[Caller, Depends(RequireRole(Role.VIEWER))]
Mes = Annotated[Caller, Depends(RequireRole(Role.MES))]
Operator = Annotated[Caller, Depends(RequireRole(Role.OPERATOR))]
Engineer = Annotated[Caller, Depends(RequireRole(Role.ENGINEER))]
Admin = Annotated[Caller, Depends(RequireRole(Role.ADMIN))]
