"""The web site in a browser: replays, predictions, sliders, search; at the width of a telephone; in dark."""

import os

import pytest
from playwright.sync_api import expect

from grader.marking.release import make_site
from tests.browser.contrast import poor_texts
from tests.browser.lab import ARTIFACTS
from tests.browser.pictures import chromium, patient_page
from tests.marking.release.test_make_site import small_course
from tests.marking.tiny import ROOT

SPHINX = ROOT / ".venv-site" / "bin" / "sphinx-build"


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> str:
    """The address of the small course's site, in a folder."""
    course = small_course(tmp_path_factory.mktemp("course"))
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(course)
        assert make_site.main(["--sphinx", str(SPHINX)]) == 0
    return (course / "dist" / "site").as_uri()


def in_browser(test):
    """Mark a test of the built site."""
    reason = "`make site` has not installed Sphinx here"
    missing = pytest.mark.skipif(not os.access(SPHINX, os.X_OK), reason=reason)
    return pytest.mark.soak(pytest.mark.browser(missing(test)))


@in_browser
def test_a_folder_without_a_server_has_replays_search_and_links(site):
    elsewhere = []
    with chromium() as browser:
        page = patient_page(browser)
        page.on("request", lambda request: elsewhere.append(request.url))
        page.goto(f"{site}/index.html")
        expect(page.locator(".home .ros2-view canvas").first).to_be_visible()
        assert "about 90 minutes" in page.locator(".home .parts").inner_text()
        assert page.locator("article").inner_text().count("points") == 1  # of the check that is shown
        page.click("article a:has-text('1 Lesson one')")
        expect(page.locator("h1")).to_contain_text("Lesson one")
        expect(page.locator(".ros2-replay .ros2-view")).to_be_visible()
        expect(page.locator("math mfrac")).to_have_count(1)
        expect(page.locator(".ros2-outcome")).not_to_contain_text("two")
        page.get_by_role("button", name="b three").focus()
        page.keyboard.press("Enter")
        expect(page.locator(".ros2-outcome.other")).to_contain_text("You predicted: three")
        page.reload()
        expect(page.locator(".ros2-outcome.other")).to_contain_text("What happened: two")
        slider = page.get_by_role("slider", name="wheels")
        expect(page.locator(".ros2-recorded .outcome")).to_have_text("2 wheels\n")
        slider.focus()
        page.keyboard.press("ArrowRight")
        expect(page.locator(".ros2-recorded .outcome")).to_have_text("3 wheels\n")
        page.goto(f"{site}/search.html?q=program")
        expect(page.locator("ul.search a").first).to_have_text("Lesson one")  # which explains it
        expect(page.locator("ul.search p.context").first).to_contain_text("A program that")
    assert [address for address in elsewhere if address.startswith("http")] == []


@in_browser
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_pages_fit_a_telephone_and_can_be_read(site, theme):
    with chromium() as browser:
        page = patient_page(browser, viewport={"width": 390, "height": 844}, color_scheme=theme)
        for name in ("index", "course/01_nodes/lesson", "exercises/01_nodes/nodes", "search"):
            page.goto(f"{site}/{name}.html{'?q=program' if name == 'search' else ''}")
            shown = {"index": ".home .ros2-view canvas", "search": "ul.search p.context"}.get(name, "h1")
            expect(page.locator(shown).first).to_be_visible()
            page.screenshot(path=ARTIFACTS / f"site-{name.rpartition('/')[2]}-{theme}.png", full_page=True)
            assert page.evaluate("document.documentElement.scrollWidth") == 390, name
            assert poor_texts(page, "article") == [], name
            if name == "search":
                found = page.inner_text("ul.search")
                assert "frac" not in found and "--" not in found
            if name == "course/01_nodes/lesson":  # whose theme indents values
                dt, dd = (page.locator(f".numbers {part}").first.bounding_box() for part in ("dt", "dd"))
                assert dt["x"] == dd["x"]


@in_browser
def test_search_works_with_the_keyboard_alone(site):
    with chromium() as browser:
        page = patient_page(browser, viewport={"width": 1440, "height": 900})
        page.goto(f"{site}/index.html")
        for _ in range(20):
            page.keyboard.press("Tab")
            if page.evaluate("document.activeElement.name") == "q":
                break
        page.keyboard.type("program")
        page.keyboard.press("Enter")
        found = page.locator("ul.search a").first
        expect(found).to_have_text("Lesson one")
        for _ in range(60):
            page.keyboard.press("Tab")
            if found.evaluate("link => link === document.activeElement"):
                break
        page.screenshot(path=ARTIFACTS / "site-search-keyboard.png")
        page.keyboard.press("Enter")
        expect(page.locator("h1")).to_contain_text("Lesson one")
