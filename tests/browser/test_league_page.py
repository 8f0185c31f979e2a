"""A league's pages as files of their own, without network: all robots of a warehouse drive together."""

import pytest

from grader.marking.extras.league.contest import Contest, game_of
from grader.marking.extras.league.league_pages import write_pages
from grader.marking.extras.league.standings import REFERENCE, LeagueRow
from sim import World, run
from tests.browser.lab import ARTIFACTS
from tests.browser.pictures import watch
from tests.students.engine.drivers import Circler, Driver, Turner

pytestmark = pytest.mark.browser
ROBOTS = {"teal heron": Circler, "the reference": Driver, "gold owl": Turner}
TIMES = "() => [...document.querySelectorAll('.time b')].map((it) => Number(it.textContent))"


@pytest.fixture(scope="module")
def league(tmp_path_factory):
    """The table of three robots that drove for 30 s in one warehouse."""
    world, rows = World.generate("warehouse", seed=2), []
    for place, (name, node) in enumerate(ROBOTS.items(), 1):
        game = game_of(run(node, world=world, seconds=30, seed=2, quiet=True))
        student, rank = (REFERENCE, 0) if name == "the reference" else (name, place)
        rows.append(LeagueRow(student, name, (game,), rank=rank))
    return write_pages(tmp_path_factory.mktemp("league"), rows, Contest("words", 1, 30.0), own=False)


def test_all_play_together_however_often_one_asks_for_it(page, league):
    page.clock.install(time=0)
    requests = watch(page)
    page.goto(league.as_uri())
    page.get_by_role("link", name="warehouse 1", exact=True).click()
    page.wait_for_selector(".ros2-view")
    assert page.evaluate(TIMES) == [30.0] * 3
    page.clock.pause_at(3_600_000)  # from here on, the page's time is the test's
    for _ in range(2):
        page.get_by_role("button", name="Play all").click()
    page.clock.run_for(1500)
    assert page.evaluate(TIMES) == pytest.approx([15.0] * 3, abs=0.5), "ten times as fast as in the warehouse"
    for scheme, width in (("light", 1100), ("dark", 420)):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size({"width": width, "height": 800})
        page.screenshot(path=ARTIFACTS / f"league-{scheme}-{width}.png")
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.clock.run_for(2000)
    assert page.evaluate(TIMES) == [30.0] * 3
    assert page.faults == [] and len(requests) == 2
