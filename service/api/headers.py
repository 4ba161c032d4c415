"""The headers of every answer: they bind what browsers may do with it, and name its trace."""

from starlette.datastructures import MutableHeaders

POLICY = (
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; object-src 'none'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


def add_guard_headers(headers: MutableHeaders, path: str, trace_id: str) -> None:
    """Add the headers that an answer does not set itself."""
    for name, value in HEADERS.items():
        headers.setdefault(name, value)
    headers["X-Trace-Id"] = trace_id
    if path.startswith("/api/"):
        headers.setdefault("Cache-Control", "no-store")
