"""The frame of the few pages that the service writes itself: no script, nothing from elsewhere."""

import html

from fastapi.responses import HTMLResponse

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem;
  color: #1a1a1a; background: #fff }
h1 { font-size: 1.6rem }
h2 { font-size: 1.25rem; margin-top: 2rem; border-bottom: 1px solid #ccc }
h3 { font-size: 1rem; margin: 1.2rem 0 .2rem }
code, pre { font: 14px/1.45 ui-monospace, monospace; background: #f4f4f4; border-radius: 4px }
code { padding: 0 .2em }
pre { padding: .7rem; overflow-x: auto }
table { border-collapse: collapse }
td, th { text-align: left; vertical-align: top; padding: .25rem .9rem .25rem 0 }
td, th { border-bottom: 1px solid #ddd }
details { margin: .3rem 0; padding: .2rem .6rem; border: 1px solid #ddd; border-radius: 6px }
summary { cursor: pointer }
.method { display: inline-block; min-width: 4.2em; font-weight: 600 }
@media (prefers-color-scheme: dark) {
  body { color: #eee; background: #161616 }
  code, pre { background: #262626 }
  a { color: #7cc4ff }
  td, th, details, h2 { border-color: #444 }
}
"""


def page(title: str, body: str, status: int = 200) -> HTMLResponse:
    """Return a page; `body` is HTML, the title is plain text."""
    name = html.escape(title)
    return HTMLResponse(
        "<!doctype html><html lang='en'><meta charset='utf-8'>"
        "<meta name='viewport' content='width=device-width'>"
        f"<title>{name} - dmscal</title><style>{STYLE}</style><h1>{name}</h1>{body}</html>",
        status_code=status,
    )
