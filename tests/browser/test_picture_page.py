"""Replays as files of their own, without network: they play, and hostile data stays a picture."""

import base64
import copy
import dataclasses
import json
import re
import zlib

import pytest
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node

from sim import World, run
from sim.evidence import Pose
from sim.notebook.shared_scripts import SharedScripts
from sim.view import animate, interactive, plot_path, plot_signal, replay, replay_data
from sim.view.interactive import plot_script
from tests.browser.lab import ARTIFACTS
from tests.browser.pictures import COLORS, Picture, patient_page, watch
from tests.sim.graphs import node
from tests.students import misfits
from tests.students.engine.pond import script

TRAIL = "2274c4"  # the color of a robot's path on a light page
pytestmark = pytest.mark.browser
PAGE = '<!doctype html><meta charset="utf-8"><meta name="color-scheme" content="light dark"><body>'


class Rammer(Node):
    """Drives into the wall of the room, and fails there."""

    def __init__(self):
        super().__init__("rammer")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)
        self.end = self.get_clock().now() + Duration(seconds=9)

    def drive(self):
        command = Twist()
        command.linear.x = 0.6
        self.publisher.publish(command)
        if self.get_clock().now() > self.end:
            self.get_logger().warning("the <b>wall</b> wins")
            raise RuntimeError("stuck")


@pytest.fixture(scope="module")
def rammed():
    return run(Rammer, world="room", seconds=20, quiet=True)


@pytest.fixture(scope="module")
def rammed_page(rammed):
    """The replay of it, as HTML, and its data."""
    data = json.loads(zlib.decompress(base64.b64decode(replay_data.pack(rammed, 1.0)), -15))
    return replay(rammed).html, data


def load(page, html, folder):
    """Open the HTML as a file."""
    path = folder / "replay.html"
    path.write_text(PAGE + html)
    page.goto(path.as_uri())


def opened(page, recording, folder):
    load(page, replay(recording).html, folder)
    page.wait_for_selector(".ros2-view")
    return Picture(page.locator(".ros2-view"))


def said(picture):
    return picture.root.locator(".say").inner_text()


def test_turtles_come_draw_and_go_in_a_replay(page, tmp_path):
    steps = (0.5, "spawn"), (0.6, "swim", "turtle1", 2.0), (1.5, "kill", "turtle2"), (2.0, "clear")
    swim = run(script(*steps), world="turtlesim", seconds=4, quiet=True)
    picture = opened(page, swim, tmp_path)
    turtle1, turtle2, line, pond = "7bc96f", "f2b84b", "b3b8ff", "4556ff"
    seen = {}
    for share in (0.1, 0.35, 0.45, 0.9):
        picture.scrub(share)
        picture.pixels()
        seen[share] = {turtle1, turtle2, line, pond} & set(picture.canvas.evaluate(COLORS))
    assert seen == {
        0.1: {turtle1, pond},
        0.35: {turtle1, turtle2, line, pond},
        0.45: {turtle1, line, pond},
        0.9: {turtle1, pond},
    }
    assert page.faults == []
    picture.screenshot("replay-turtles")


def test_a_replay_plays_and_asks_for_nothing(page, rammed, tmp_path):
    requests = watch(page)
    picture = opened(page, rammed, tmp_path)
    picture.plays()
    assert [url for url in requests if not url.startswith(("file:", "data:", "blob:"))] == []
    assert page.faults == []
    assert page.locator("img").count() == 0
    picture.screenshot("replay-file")


def test_it_begins_at_the_end_and_can_be_stepped(page, rammed, tmp_path):
    picture = opened(page, rammed, tmp_path)
    end = rammed.ended.stamp
    assert picture.time() == pytest.approx(end, abs=0.01)
    picture.click("One frame back")
    assert picture.time() == pytest.approx(end - 0.05, abs=0.051)
    before = picture.time()
    picture.click("One frame back")
    assert picture.time() == pytest.approx(before - 0.05, abs=0.011)
    picture.click("One frame forward")
    assert picture.time() == pytest.approx(before, abs=0.011)


def test_marks_lead_to_what_happened_and_say_it(page, rammed, tmp_path):
    picture = opened(page, rammed, tmp_path)
    contact = rammed.contacts[0].stamp
    words = f"t = {contact:.3g} s: touched a wall with its front"
    picture.scrub(0.0)
    assert said(picture) == ""
    picture.click(words)
    assert (said(picture), picture.time()) == (words, pytest.approx(contact, abs=0.01))
    picture.click("t = 9.1 s: RuntimeError in Rammer.drive: stuck")
    assert picture.time() == pytest.approx(9.1)
    assert said(picture) == "t = 9.1 s: RuntimeError in Rammer.drive: stuck"


def test_log_lines_are_text(page, rammed, tmp_path):
    picture = opened(page, rammed, tmp_path)
    assert picture.root.locator(".logs").inner_text() == "9.10 rammer: the <b>wall</b> wins"
    picture.scrub(0.2)
    assert picture.root.locator(".logs").inner_text() == ""


def test_topics_have_their_rates(page, rammed, tmp_path):
    topics = opened(page, rammed, tmp_path).root.locator(".topic").all_inner_texts()
    assert "/scan\n20 Hz" in topics
    assert "/cmd_vel\n10 Hz" in topics


def floor(picture):
    """The color of the floor in the middle of the picture: red, green, blue."""
    return picture.canvas.evaluate(
        "c => [...c.getContext('2d').getImageData(c.width * 0.46, c.height * 0.46, 1, 1).data].slice(0, 3)"
    )


def test_a_dark_page_has_a_dark_picture_and_a_change_of_theme_is_followed(page, rammed, tmp_path):
    picture = opened(page, rammed, tmp_path)
    picture.scrub(0.0)
    picture.pixels()
    assert min(floor(picture)) > 200
    page.emulate_media(color_scheme="dark")
    picture.wait_until(
        "root => { const c = root.querySelector('.stage canvas');"
        "return c.getContext('2d').getImageData(c.width * 0.46, c.height * 0.46, 1, 1).data[0] < 90; }"
    )
    picture.screenshot("replay-file-dark")


def test_the_picture_is_as_wide_as_its_place_and_sharp(browser, rammed, tmp_path):
    page = patient_page(browser, viewport={"width": 380, "height": 800}, device_scale_factor=2)
    picture = opened(page, rammed, tmp_path)
    width = picture.canvas.bounding_box()["width"]
    assert 330 < width < 380
    assert picture.canvas.evaluate("canvas => canvas.width") == pytest.approx(2 * width, abs=2)
    picture.screenshot("replay-file-narrow")
    page.close()


def test_two_replays_of_one_page_play_apart_from_each_other(page, rammed, tmp_path):
    load(page, replay(rammed).html + replay(rammed.during(0, 9.0)).html, tmp_path)
    page.wait_for_function("document.querySelectorAll('.ros2-view').length === 2")
    first, second = (Picture(page.locator(".ros2-view").nth(index)) for index in (0, 1))
    end = second.time()
    first.scrub(0.5)
    assert first.time() < end == second.time()


def test_a_replay_that_plays_at_once_does_so_unless_motion_shall_be_reduced(page, rammed, tmp_path):
    load(page, replay(rammed, speed=0.25, plays=True).html, tmp_path)
    Picture(page.locator(".ros2-view")).wait_until("root => root.querySelector('[aria-label=Pause]')")
    page.emulate_media(reduced_motion="reduce")
    page.reload()
    picture = Picture(page.locator(".ros2-view"))
    assert picture.time() == rammed.stamp
    assert picture.root.get_by_role("button", name="Play", exact=True).is_visible()
    page.emulate_media(reduced_motion="null")


LEAST_TIME = """root => {
    const time = root.querySelector('.time b');
    window.leastTime = Infinity;
    new MutationObserver(() => { window.leastTime = Math.min(window.leastTime, Number(time.textContent)); })
        .observe(time, { childList: true, characterData: true, subtree: true });
}"""


def test_an_animation_plays_by_itself_when_it_comes_into_sight(page, rammed, tmp_path):
    html = animate(rammed, speed=10).html
    load(page, f'<div style="height: 3000px"></div>{html}', tmp_path)
    page.wait_for_selector(".ros2-view", state="attached")
    picture = Picture(page.locator(".ros2-view"))
    assert picture.time() == pytest.approx(rammed.ended.stamp, abs=0.01)
    assert picture.root.locator(".failure").inner_text() == rammed.failure
    picture.root.evaluate(LEAST_TIME)  # it may have played before anything here can look
    picture.root.scroll_into_view_if_needed()
    page.wait_for_function("window.leastTime < 5")
    picture.wait_for_time(rammed.ended.stamp - 0.02)
    assert page.faults == []


def test_plots_and_replays_without_a_script_use_that_of_another_output(page, rammed, tmp_path, monkeypatch):
    scripts = SharedScripts()
    monkeypatch.setattr(interactive, "shared_scripts", lambda: scripts)
    scripts.begin("cell")
    plots = [plot_signal(rammed, "/cmd_vel", "linear.x") for _ in range(3)]
    made = [*plots, replay(rammed), plot_path(rammed)]
    pages = [each._repr_mimebundle_()["text/html"] for each in made]
    load(page, "\n".join(pages), tmp_path)
    page.wait_for_function("document.querySelectorAll('.ros2-time-plot').length === 3")
    page.wait_for_function("document.querySelectorAll('.ros2-view:not(.ros2-time-plot)').length === 2")
    assert page.locator("img").count() == 0 and page.faults == []
    page.screenshot(path=ARTIFACTS / "several-plots.png", full_page=True)


def test_two_replays_of_one_run_have_one_cursor(page, rammed, tmp_path):
    html = replay(rammed).html
    load(page, html + html, tmp_path)
    page.wait_for_function("document.querySelectorAll('.ros2-view').length === 2")
    first, second = (Picture(page.locator(".ros2-view").nth(index)) for index in (0, 1))
    first.scrub(0.5)
    assert first.time() == second.time() == pytest.approx(rammed.stamp / 2, abs=0.1)
    second.click("Play")
    first.wait_for_time(second.time())


def test_a_plot_zooms_in_all_its_panels_and_moves_its_cursor_by_keys(page, rammed, tmp_path):
    load(page, plot_signal(rammed, "/odom", "pose.pose.position.x", "twist.twist.linear.x").html, tmp_path)
    plot = page.locator(".ros2-time-plot")
    over = plot.locator(".u-over").first
    over.wait_for()
    assert plot.locator(".uplot").count() == 2
    size = over.bounding_box()
    middle = size["y"] + size["height"] / 2
    page.mouse.move(size["x"] + 0.2 * size["width"], middle)
    page.mouse.down()
    page.mouse.move(size["x"] + 0.4 * size["width"], middle, steps=3)
    page.mouse.up()
    moments = []
    for panel in plot.locator(".u-over").all():
        width = panel.bounding_box()["width"]
        panel.hover(position={"x": 0.5 * width, "y": 20})
        moments.append(said(Picture(plot)))
    assert moments == ["t = 3.03 s"] * 2
    plot.press("ArrowRight")
    assert said(Picture(plot)) == "t = 3.05 s"
    over.dblclick(position={"x": 0.5 * size["width"], "y": 20})
    over.hover(position={"x": 0.9 * size["width"], "y": 20})
    assert said(Picture(plot)).startswith("t = 9.09 s. t = 9.1 s: RuntimeError in Rammer.drive")
    assert page.faults == []


def test_a_path_shows_the_robot_at_the_cursor_and_names_the_failure(page, rammed, tmp_path):
    load(page, plot_path(rammed).html + replay(rammed).html, tmp_path)
    drawn, played = (Picture(page.locator(name)) for name in (".ros2-path", ".ros2-view:has(.scrub)"))
    played.canvas.wait_for()
    assert drawn.root.locator(".failure").inner_text() == rammed.failure
    entries = drawn.root.locator(".legend span > span:not(.time)").all_inner_texts()
    assert entries == ["— path", "● start", "★ goal", "✕ contact"]
    end = drawn.pixels()
    played.scrub(0.25)
    assert drawn.root.locator(".time").inner_text() == f"t = {played.time():.2f} s"
    assert drawn.pixels() != end
    assert page.faults == []


@pytest.mark.parametrize("data", ["", "AAAA", "no base64!"])
def test_a_plot_with_wrong_data_stays_a_picture(page, tmp_path, data):
    html = f'<div class="ros2-plot" data-plot="{data}"><img src="data:," alt="still"></div>'
    load(page, f"{html}<script>{plot_script()}</script>", tmp_path)
    page.wait_for_selector("[data-wired]")
    page.wait_for_function("document.querySelector('.ros2-plot img') !== null")
    assert page.locator(".ros2-time-plot").count() == 0


def test_the_picture_zooms_pans_and_follows_by_keys_and_by_the_pointer(page, rammed, tmp_path):
    picture = opened(page, rammed, tmp_path)
    whole = picture.pixels()
    picture.canvas.focus()
    shown = {whole}
    for key in ("+", "Shift+ArrowLeft", "Shift+ArrowDown", "-", "f"):
        page.keyboard.press(key)
        shown.add(picture.pixels())
    assert len(shown) == 5  # at a zoom of 1 there is nothing to pan
    follow = picture.root.get_by_role("button", name="Follow the robot (F)")
    assert follow.get_attribute("aria-pressed") == "true"
    end = picture.pixels()
    picture.scrub(0.0)
    assert picture.pixels() != end
    page.keyboard.press("Tab")  # out of the scrub bar
    picture.click("Show everything (0)")
    assert follow.get_attribute("aria-pressed") == "false"
    picture.scrub(1.0)
    assert picture.pixels() == whole
    picture.click("Zoom in (+)")
    zoomed = picture.pixels()
    box = picture.canvas.bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 140, box["y"] + 130)
    page.mouse.up()
    assert picture.pixels() not in (whole, zoomed)
    assert page.faults == []
    picture.screenshot("replay-zoomed")


def test_the_robot_is_large_enough_to_be_seen_in_a_large_world(page, tmp_path):
    hall = World(name="hall", card="Picture: A large hall.", bounds=(-50.0, -50.0, 50.0, 50.0))
    picture = opened(page, run(world=hall, seconds=1, quiet=True), tmp_path)
    assert TRAIL in picture.canvas.evaluate(COLORS)


def test_the_arm_s_tip_draws_its_path(page, tmp_path):
    arm = run(world="arm", seconds=1, quiet=True)
    turning = [Pose(n / 20, 0.0, 0.0, n / 20) for n in range(21)]
    moved = dataclasses.replace(arm, tracks={"upper_arm": turning, "forearm": turning})
    picture = opened(page, moved, tmp_path)
    assert TRAIL in picture.canvas.evaluate(COLORS)
    picture.scrub(0.0)
    picture.pixels()  # after the next paint
    assert TRAIL not in picture.canvas.evaluate(COLORS)


def test_the_graph_is_folded_and_opens_by_the_keyboard(page, tmp_path):
    nodes = [node("talker", ["news"]), node("paper", [], ["newz"])]
    picture = opened(page, run(*nodes, seconds=2, quiet=True), tmp_path)
    graph = picture.root.locator(".graph")
    summary, drawing = graph.locator("summary"), graph.locator(".wires svg")
    assert summary.inner_text() == "GRAPH: 1 MISSING CONNECTION"
    assert not drawing.is_visible()
    summary.press("Enter")
    drawing.wait_for()
    assert drawing.locator("text").all_text_contents() == [
        "/talker", "/paper", "/news", "10 Hz", "/newz", "0 messages", "1", "1",
    ]  # fmt: skip
    assert drawing.get_attribute("aria-label").startswith("topic /news (10 Hz): /talker -> no node")
    (reason,) = graph.locator("li").all_inner_texts()
    assert reason.startswith("/paper receives nothing: no node publishes on /newz, but /talker publishes on ")
    red = drawing.locator(".gap .line").first
    color = "path => getComputedStyle(path).stroke"
    light = red.evaluate(color)
    page.emulate_media(color_scheme="dark")
    changed_color = "(root, light) => getComputedStyle(root.querySelector('.gap .line')).stroke !== light"
    picture.wait_until(changed_color, light)
    assert page.faults == []
    page.set_viewport_size({"width": 320, "height": 800})
    box = graph.bounding_box()
    assert box["x"] + box["width"] <= 320
    picture.screenshot("replay-graph-narrow-dark")


def test_a_replay_from_before_there_were_graphs_plays_without(page, rammed_page, tmp_path):
    html, data = rammed_page
    old = packed({name: part for name, part in data.items() if name != "graph"})
    html = re.sub('data-replay="[^"]*"', lambda _: f'data-replay="{old}"', html)
    load(page, html, tmp_path)
    page.wait_for_selector(".ros2-view")
    assert page.locator(".graph").is_hidden()


def test_a_run_without_a_robot_replays_its_topics(page, tmp_path):
    picture = opened(page, run(misfits.Talker, seconds=5, quiet=True), tmp_path)
    assert picture.root.locator(".stage").count() == 0
    assert picture.root.locator(".topic").all_inner_texts() == ["/chatter\n1 Hz"]
    picture.scrub(0.5)
    picture.click("One frame forward")
    assert picture.time() == pytest.approx(2.55, abs=0.1)


def test_machines_replay_too(page, tmp_path):
    picture = opened(page, run(world="cart_pole", seconds=2, quiet=True), tmp_path)
    end = picture.pixels()
    picture.scrub(0.5)
    assert picture.pixels() != end
    assert page.faults == []


def test_without_scripts_the_picture_stays(browser, rammed, tmp_path):
    page = patient_page(browser, java_script_enabled=False)
    load(page, replay(rammed).html, tmp_path)
    assert page.locator("img").bounding_box()["width"] > 600
    page.close()


def packed(data):
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    return base64.b64encode(deflate.compress(text) + deflate.flush()).decode()


def changed(*keys, to):
    """Data of a run with one part that a hostile sender replaced."""

    def change(data):
        *way, last = keys
        place = data
        for key in way:
            place = place[key]
        place[last] = to
        return packed(data)

    return change


HOSTILE = {
    "no base64": lambda data: "%%%",
    "nothing": lambda data: "",
    "no deflate": lambda data: "QUJD",
    "no json": lambda data: packed(b"alert(1)"),
    "a list": lambda data: packed([]),
    "null": lambda data: packed(None),
    "another version": changed("version", to=99),
    "a text for a number": changed("end", to="<img src=x onerror=alert(1)>"),
    "a negative end": changed("end", to=-1),
    "words that are none": changed("marks", 0, 2, to={"toString": "x"}),
    "a strange kind": changed("marks", 0, 1, to="contact evil"),
    "a mark without stamp": changed("marks", 0, 0, to=None),
    "no bounds": changed("world", "bounds", to=[0, 0, 0, 0]),
    "a huge number": changed("world", "bounds", to=[0, 0, 1e300, 1]),
    "a wall that is none": changed("world", "walls", to=[[1, 2, 3]]),
    "a negative pillar": changed("world", "circles", to=[[0, 0, -1]]),
    "too few poses": changed("tracks", 0, 0, to=[0]),
    "no track": changed("tracks", to=[]),
    "time that runs back": changed("stamps", 1, to=-5),
    "a range that is none": changed("scans", 0, "ranges", to=["1"]),
    "too many topics": changed("topics", to=[["/a", "b", "0"]] * 101),
    "a strip without end": changed("topics", 0, 2, to="1" * 10_000),
    "a box of a strange kind": changed("graph", "boxes", 0, "kind", to="x onload=alert(1)"),
    "a box without a place": changed("graph", "boxes", 0, "place", to=["0", 0, 1, 1]),
    "an arrow that leads nowhere": changed("graph", "arrows", 0, "points", to=[1, 2, 3]),
    "words of a graph that are none": changed("graph", "words", to={}),
    "a bomb": lambda data: packed(b" " * 40_000_000),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_data_stays_a_picture(page, rammed_page, tmp_path, name):
    html, data = rammed_page
    hostile = f'data-replay="{HOSTILE[name](copy.deepcopy(data))}"'
    html = re.sub('data-replay="[^"]*"', lambda _: hostile, html)
    warnings = []
    page.on("console", lambda message: warnings.append(message.text))
    load(page, html, tmp_path)
    while not warnings:
        page.wait_for_event("console")
    assert warnings[0].startswith("This replay stays a picture: ")
    assert (page.locator("img").count(), page.locator(".ros2-view").count(), page.faults) == (1, 0, [])
