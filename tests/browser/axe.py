"""Whether pages can be used by everybody, as far as axe finds out."""

from pathlib import Path

from playwright.sync_api import Page

AXE = Path(__file__).resolve().parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
LOOK = """async () => {
    const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];
    const { violations } = await axe.run(document, { resultTypes: ['violations'], runOnly: tags });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) =>
        `${id}: ${target.join(' ')}: ${failureSummary.split('\\n')[1]?.trim()}`));
}"""


class Access:
    """What axe finds on screens, by the rules of WCAG 2.2 AA and best practice, in light and in dark."""

    def __init__(self) -> None:
        self.found: list[str] = []

    def look(self, page: Page, where: str) -> None:
        """Let axe look at what is on show."""
        if not page.evaluate("'axe' in window"):
            page.evaluate(AXE.read_text())
        for theme in ("light", "dark"):
            page.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
            self.found += [f"{where}, {theme}: {one}" for one in page.evaluate(LOOK)]
        page.evaluate("delete document.documentElement.dataset.theme")
