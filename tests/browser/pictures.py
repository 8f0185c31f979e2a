"""The live picture and the replay in a page of Chromium, as someone uses them."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import Browser, Locator, Page, expect, sync_playwright

from tests.browser.lab import ARTIFACTS
from tests.patience import PATIENCE

CHROMIUM = shutil.which("chromium")
# A frame counts when something was drawn on a canvas before the browser painted next.
COUNT_FRAMES = """
    window.framesPainted = 0;
    let asked = false;
    const fillRect = CanvasRenderingContext2D.prototype.fillRect;
    CanvasRenderingContext2D.prototype.fillRect = function (...where) {
        if (!asked) {
            asked = true;
            requestAnimationFrame(() => { asked = false; window.framesPainted += 1; });
        }
        return fillRect.apply(this, where);
    };
"""
PIXELS = """canvas => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(
    () => done(canvas.toDataURL()))))"""
# The colors that cover more than a few pixels of a canvas, as RRGGBB.
COLORS = """canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const counts = {};
    for (let i = 0; i < data.length; i += 4) {
        const color = (data[i] << 16 | data[i + 1] << 8 | data[i + 2]).toString(16).padStart(6, "0");
        counts[color] = (counts[color] || 0) + 1;
    }
    return Object.keys(counts).filter((color) => counts[color] > 15);
}"""


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start Chromium. Not for a whole session: as long as playwright lives, this thread has an event loop."""
    with sync_playwright() as playwright:
        # Chromium's own sandbox does not run as root, the ordinary user in a container.
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox"], timeout=PATIENCE * 1000
        )
        expect.set_options(timeout=PATIENCE * 1000)
        yield browser
        browser.close()


def patient_page(browser: Browser, **settings: Any) -> Page:
    """Open a tab whose actions wait as long as tests do, not for half a minute. settings: of `new_page`."""
    page = browser.new_page(**settings)
    page.set_default_timeout(PATIENCE * 1000)
    return page


def watch(page: Page) -> list[str]:
    """Note the address of whatever the page asks for from now on."""
    requests: list[str] = []
    page.on("request", lambda request: requests.append(request.url))
    return requests


def point_at(plot: Locator, share: float) -> None:
    """Move the pointer over this share of the time that a plot shows, in its first panel."""
    over = plot.locator(".u-over").first
    over.scroll_into_view_if_needed()
    size = over.bounding_box()
    over.hover(position={"x": share * size["width"], "y": size["height"] / 2})


class Picture:
    """A live picture or a replay. The locator finds its root, a `.ros2-view`."""

    def __init__(self, root: Locator):
        self.root = root
        self.page = root.page
        self.canvas = root.locator(".stage canvas")

    def time(self) -> float:
        """Return the simulated time that shows, in seconds."""
        return float(self.root.locator(".time b").inner_text())

    def value(self, label: str) -> str:
        """Return the value of this label in the strip."""
        term = self.page.locator(f"dt:text-is('{label}')")
        return self.root.locator(".numbers div", has=term).locator("dd").inner_text()

    def click(self, label: str) -> None:
        """Click the button of this label."""
        self.root.get_by_role("button", name=label, exact=True).click()

    def pixels(self) -> str:
        """Return what the canvas shows after the next paint, as a data URL."""
        return self.canvas.evaluate(PIXELS)

    def scrub(self, share: float) -> None:
        """Move the scrub bar to this share of the run."""
        bar = self.root.get_by_role("slider")
        bar.hover()  # when it shows and has come to rest: it has no box before
        size = bar.bounding_box()
        bar.click(position={"x": 7 + share * (size["width"] - 14), "y": size["height"] / 2})

    def wait_until(self, condition: str, argument: object = None) -> None:
        """Wait until a JavaScript function of the root and the argument gives true."""
        root = self.root.element_handle()
        root.owner_frame().wait_for_function(
            f"([root, argument]) => ({condition})(root, argument)",
            arg=[root, argument],
            timeout=PATIENCE * 1000,
        )

    def wait_for_time(self, stamp: float) -> None:
        """Wait until the simulated time that shows has passed `stamp`."""
        self.wait_until("(root, stamp) => Number(root.querySelector('.time b').textContent) > stamp", stamp)

    def screenshot(self, name: str) -> None:
        """Save a picture of the page, with this one in the middle, as test-artifacts/NAME.png."""
        self.root.evaluate("root => root.scrollIntoView({block: 'center'})")
        self.page.screenshot(path=ARTIFACTS / f"{name}.png")

    def plays(self) -> None:
        """Assert that the replay plays from its begin, and that the scrub bar moves the robot."""
        self.scrub(0.0)
        begin, first = self.time(), self.pixels()
        self.click("Play")
        self.wait_for_time(begin + 0.5)  # a short one may have come to its end, where nothing is to be paused
        assert self.pixels() != first
        self.scrub(1.0)
        last = self.pixels()
        self.scrub(0.5)
        assert last != self.pixels() != first
