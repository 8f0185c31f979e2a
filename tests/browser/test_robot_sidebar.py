"""The robot's place is JupyterLab's right sidebar: it follows the notebook, and is in sight at every size."""

import pytest

from tests.browser.lab import SHOWN, write_notebook
from tests.browser.pictures import Picture
from tests.browser.test_play_in_lab import CIRCLE, IMPORTS, eventually, live
from tests.browser.test_success_in_lab import ANNOUNCED
from tests.patience import until

pytestmark = pytest.mark.browser
BUSY = "import os, time\nwhile not os.path.exists('go'): time.sleep(0.1)"
LARGE = {"width": 1440, "height": 900}
VISIBLE = """() => {
    const shown = document.querySelector('.ros2-course-robot:not(.lm-mod-hidden) .stage canvas');
    const canvas = shown.getBoundingClientRect();
    return Math.min(canvas.bottom, innerHeight) - Math.max(canvas.top, 0) - canvas.height;
}"""


@pytest.fixture
def playing(request, students_folder, open_lab):
    """JupyterLab at 1440 px while a robot plays; a second notebook has none."""
    name = f"sidebar/{request.node.originalname}"
    write_notebook(students_folder / f"{name}.ipynb", IMPORTS, CIRCLE, BUSY)
    write_notebook(students_folder / f"{name}-other.ipynb", "1 + 1")
    with open_lab(f"{name}.ipynb") as lab:
        lab.page.set_viewport_size(LARGE)
        lab.run_cell(0)
        lab.run_cell(1)
        live(lab).wait_for_time(0.2)
        lab.other = f"{name}-other.ipynb"
        yield lab


def sidebar(lab):
    return lab.page.locator(".ros2-course-robots")


def is_whole(lab) -> bool:
    """Whether the whole picture is in the window."""
    return abs(lab.page.evaluate(VISIBLE)) < 2


@pytest.mark.parametrize(
    "size",
    [(1440, 900), (900, 700), (720, 450), (640, 400)],
    ids=["1440", "900", "1440-at-200-percent", "1280-at-200-percent"],
)
def test_the_whole_picture_is_in_sight_at_every_size(playing, size, request):
    playing.page.set_viewport_size({"width": size[0], "height": size[1]})
    playing.page.evaluate("window.jupyterapp.shell.collapseRight()")
    playing.page.get_by_role("button", name="Show the robot").click()
    live(playing).wait_for_time(live(playing).time() + 0.3)
    box = live(playing).canvas.bounding_box()
    assert box["width"] >= 140 and box["height"] >= 140
    playing.screenshot(f"sidebar-{size[0]}")
    assert is_whole(playing)
    playing.page.evaluate("document.querySelector('.ros2-course-robot > *').scrollTo(0, 10000)")
    assert is_whole(playing)  # the picture stays while the rest scrolls


def test_the_picture_and_the_notebook_stay_in_sight_when_the_window_becomes_small(playing):
    notebook = playing.page.locator(SHOWN)
    for width, height in ((900, 700), (720, 450)):
        playing.page.set_viewport_size({"width": width, "height": height})
        live(playing).wait_for_time(live(playing).time() + 0.3)
        until(lambda: is_whole(playing), "the whole picture")
        until(lambda: notebook.bounding_box()["width"] > 200, "a notebook that is wide enough")


def test_the_robot_has_its_width_back_when_the_window_is_wide_again(playing):
    before = live(playing).canvas.bounding_box()["width"]
    playing.page.set_viewport_size({"width": 480, "height": 900})
    until(lambda: live(playing).canvas.bounding_box()["width"] < before - 50, "a narrow picture")
    playing.screenshot("sidebar-480")
    playing.page.set_viewport_size(LARGE)
    until(lambda: live(playing).canvas.bounding_box()["width"] > 0.9 * before, "the width of before")
    playing.screenshot("sidebar-again")


def test_the_zoom_buttons_are_not_on_the_picture_and_the_robot_button_closes_the_panel(playing):
    picture, zoom = live(playing).canvas.bounding_box(), live(playing).root.locator(".zoom").bounding_box()
    assert zoom["y"] >= picture["y"] + picture["height"] - 1
    button = playing.page.locator(SHOWN).get_by_role("button", name="Robot", exact=True)
    button.click()
    until(lambda: not sidebar(playing).is_visible(), "a closed panel")
    button.click()
    live(playing).canvas.wait_for()


def test_the_values_of_a_replay_are_next_to_their_labels(playing):
    live(playing).click("End the run")
    strip = playing.cell(1).locator(".numbers div")
    strip.first.wait_for()
    for entry in strip.all():
        term, value = (entry.locator(tag).bounding_box() for tag in ("dt", "dd"))
        assert term["y"] + term["height"] <= value["y"] + 1 and term["x"] == pytest.approx(value["x"], abs=1)


def test_a_toolbar_that_is_too_full_covers_no_cell(playing):
    below = """() => {
        const toolbar = window.notebook().toolbar.node, { left, bottom } = toolbar.getBoundingClientRect();
        const wide = document.createElement("div"), late = document.createElement("div");
        wide.style.cssText = "flex: 0 0 2000px";
        late.style.cssText = "flex: 0 0 100%; height: 30px";
        toolbar.append(wide, late);
        const found = toolbar.contains(document.elementFromPoint(left + 60, bottom + 10));
        wide.remove();
        late.remove();
        return found;
    }"""
    assert playing.page.evaluate(below) is False


def test_it_is_dark_in_a_dark_theme(playing):
    playing._use_theme("JupyterLab Dark")
    try:
        live(playing).wait_for_time(live(playing).time() + 0.5)
        playing.screenshot("sidebar-dark")
    finally:
        playing._use_theme("JupyterLab Light")


def test_a_document_that_is_opened_does_not_cover_it(playing):
    live(playing).canvas.click()
    playing.command("docmanager:open", path="course/glossary.md", factory="Markdown Preview")
    playing.page.locator(".jp-MarkdownViewer").wait_for()
    assert live(playing).canvas.is_visible()
    box, document = sidebar(playing).bounding_box(), playing.page.locator(".jp-MarkdownViewer").bounding_box()
    assert document["x"] + document["width"] <= box["x"] + 1


def test_it_follows_the_active_notebook(playing):
    first = playing.page.evaluate("window.notebook().context.path")
    playing.turn_to(playing.other)
    sidebar(playing).wait_for(state="hidden")  # the other notebook has the whole window
    playing.turn_to(first)
    sidebar(playing).wait_for()
    live(playing).wait_for_time(live(playing).time() + 0.2)


def test_a_restarted_kernel_has_no_robot_and_the_cell_does_not_claim_one(playing):
    playing.page.get_by_text("The robot plays in the panel").wait_for()
    playing.page.evaluate("window.notebook().sessionContext.session.kernel.restart()")
    notice = "The kernel was restarted, and the robot is gone. Run the cells again, and it drives here."
    playing.page.locator(".ros2-course-notice", has_text=notice).wait_for()
    assert playing.page.evaluate(ANNOUNCED) == notice
    playing.page.get_by_text("A robot played here. Run the cell to let it play again.").wait_for()
    assert playing.page.get_by_role("button", name="Show the robot").count() == 0


def test_a_second_view_of_the_output_says_that_the_robot_plays(playing):
    text = playing.page.get_by_text("The robot plays in the panel")
    text.wait_for()
    playing.page.evaluate("window.notebook().content.activeCellIndex = 1")
    playing.command("notebook:create-output-view")
    text.nth(1).wait_for()
    assert playing.page.get_by_text("A robot played here.").count() == 0


def test_saved_output_does_not_claim_that_the_robot_plays(playing):
    playing.save()
    name = playing.page.evaluate("window.notebook().context.path")
    playing.leave()
    playing.open(name)
    playing.page.get_by_text("A robot played here. Run the cell to let it play again.").wait_for()
    assert playing.page.get_by_role("button", name="Show the robot").count() == 0


def test_while_a_cell_computes_the_picture_says_that_it_waits(playing, students_folder):
    playing.run_cell(2, wait=False)
    root = live(playing).root
    root.locator(".say", has_text="The robot waits: the kernel is busy with another cell").wait_for()
    assert "waits" in root.locator(".bar").inner_text()
    (students_folder / "sidebar" / "go").touch()
    playing.wait_for_cell(2)
    Picture(root).wait_until("root => !root.classList.contains('waits')")
    Picture(root).wait_until("root => /runs at/.test(root.innerText)")


def test_the_hint_goes_with_the_first_key_and_a_topic_opens_next_to_its_row(playing):
    root = live(playing).root
    assert root.locator(".how").is_visible()
    live(playing).canvas.click()
    playing.page.keyboard.press("ArrowUp", delay=50)
    root.locator(".how").wait_for(state="hidden")
    topic = root.locator("button.topic", has_text="/odom")
    topic.click()
    root.locator("button.topic:has-text('/odom') + .looked").wait_for()
    assert not root.locator("button.topic", has_text="/tf_static").is_visible()
    root.get_by_text("More topics").click()
    static = root.locator("button.topic", has_text="/tf_static")
    assert "1 message" in static.inner_text()
    playing.screenshot("sidebar-topic")


def test_a_contact_is_announced_with_its_time(playing):
    playing.ask("globals().update(player=play(world='room', seconds=600, speed=4))")
    picture = live(playing)
    picture.wait_for_time(0.2)
    picture.canvas.click()
    playing.page.keyboard.down("ArrowUp")
    eventually(playing, "player.recording.contacts != []")
    said = picture.root.locator(".say[role=status]", has_text="Contacts: 1, at ")
    said.wait_for()
    playing.screenshot("sidebar-contact")
    playing.page.keyboard.up("ArrowUp")
