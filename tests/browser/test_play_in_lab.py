"""A robot plays in the notebook: it moves, it is driven, and other cells go on meanwhile."""

from contextlib import contextmanager

import pytest
from playwright.sync_api import Locator, expect

from tests.browser.lab import write_notebook
from tests.browser.pictures import Picture
from tests.patience import PATIENCE, until

pytestmark = pytest.mark.browser
IMPORTS = """
import math
import time
from rclpy.node import Node
from geometry_msgs.msg import Twist
from sim import Process, Teleop, play, run

class Circle(Node):
    def __init__(self):
        super().__init__("circle")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.4, 0.5
        self.publisher.publish(twist)

def way(player):
    "Meters driven so far."
    path = player.recording.path
    return sum(math.dist(a[1:3], b[1:3]) for a, b in zip(path, path[1:]))

def sent(player, topic):
    "What the newest command on a topic was, and how many there were."
    twists = [received.message for received in player.recording.messages(topic)]
    return [len(twists), twists[-1].linear.x, twists[-1].angular.z] if twists else [0, 0.0, 0.0]
"""
DRIVEN = "player = play(Teleop, world='yard', seconds=600)"
CIRCLE = "player = play(Circle, world='room', seconds=600)"
ENDED = "list(player.recording.ended)"


@contextmanager
def lab_that_ran(request, folder, open_lab):
    """JupyterLab with a notebook whose second cell, the test's parameter, was run; more cells may follow."""
    cells = request.param if isinstance(request.param, tuple) else (request.param,)
    name = f"pictures/{request.node.originalname}.ipynb"
    write_notebook(folder / name, IMPORTS, *cells)
    with open_lab(name) as lab:
        lab.run_cell(0)
        lab.run_cell(1)
        yield lab


@pytest.fixture
def playing(request, students_folder, open_lab):
    """JupyterLab while the cell that was run plays."""
    with lab_that_ran(request, students_folder, open_lab) as lab:
        live(lab).wait_for_time(0.2)
        yield lab
        lab.page.keyboard.up("ArrowUp")  # some tests end with it held


@pytest.fixture
def played(request, students_folder, open_lab):
    """JupyterLab when the cell that was run has played: no one may have seen it play, if it was short."""
    with lab_that_ran(request, students_folder, open_lab) as lab:
        eventually(lab, f"{ENDED}[0] == 'time'")
        yield lab


def live(lab) -> Picture:
    return Picture(lab.page.locator(".ros2-view.live").last)


def replay(lab) -> Picture:
    root = lab.page.locator(".ros2-replay .ros2-view")
    root.last.wait_for()
    return Picture(root.last)


def eventually(lab, expression: str) -> None:
    """Wait until a Python expression is true in the kernel."""
    until(lambda: lab.ask(expression) or lab.page.wait_for_timeout(100), expression)


def count_becomes(locator: Locator, count: int) -> None:
    """Wait until the page has so many of them: it may be about to add or to remove one."""
    expect(locator).to_have_count(count, timeout=PATIENCE * 1000)


def stands(lab) -> bool:
    """Whether the robot, once it has had time to brake, stands still for half a second."""
    stamp, ways = lab.ask("player.recording.stamp"), []
    for later in (0.5, 1.0):
        eventually(lab, f"player.recording.stamp > {stamp} + {later}")
        ways.append(lab.ask("way(player)"))
    return ways[1] - ways[0] < 1e-3


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_the_picture_moves(playing):
    picture = live(playing)
    first = picture.pixels()
    before = playing.page.evaluate("framesPainted")
    playing.page.wait_for_function("before => framesPainted >= before + 150", arg=before)
    assert picture.pixels() != first
    assert "/scan" in picture.root.inner_text()
    picture.screenshot("play-light")


@pytest.mark.parametrize("playing", [DRIVEN], indirect=True)
def test_keys_drive_the_robot_and_leave_the_notebook_alone(playing):
    cells = playing.sources()
    picture = live(playing)
    picture.canvas.click()
    keyboard = playing.page.keyboard
    keyboard.down("ArrowUp")
    eventually(playing, "way(player) > 0.2")
    picture.screenshot("play-keys")
    keyboard.up("ArrowUp")
    eventually(playing, "sent(player, '/cmd_vel')[1:] == [0.0, 0.0]")
    for key in ("KeyA", "KeyD", "KeyD", "KeyB", "KeyX", "KeyV", "KeyM", "KeyY", "Enter", "Space"):
        keyboard.press(key, delay=30)
    keyboard.down("KeyA")
    eventually(playing, "sent(player, '/cmd_vel')[2] > 0")
    keyboard.up("KeyA")
    eventually(playing, "sent(player, '/cmd_vel')[1:] == [0.0, 0.0]")
    count = playing.ask("sent(player, '/cmd_vel')[0]")
    assert stands(playing)
    assert playing.ask("sent(player, '/cmd_vel')[0]") == count  # nothing held, nothing sent
    assert playing.sources() == cells
    assert playing.page.evaluate("window.notebook().content.mode") == "command"


@pytest.mark.parametrize("playing", [DRIVEN], indirect=True)
@pytest.mark.parametrize("way_out", ["another cell", "another tab", "the page is closed"])
def test_a_robot_that_loses_its_driver_stops(playing, way_out):
    live(playing).canvas.click()
    playing.page.keyboard.down("ArrowUp")
    eventually(playing, "sent(player, '/cmd_vel')[1] > 0")
    if way_out == "another cell":
        playing.cell(0).locator(".cm-content").click()
    elif way_out == "another tab":
        playing.page.evaluate("window.dispatchEvent(new Event('blur'))")
    else:
        playing.page.reload()
        playing.wait_for_kernel()
    eventually(playing, "sent(player, '/cmd_vel')[1:] == [0.0, 0.0]")
    assert stands(playing)


@pytest.mark.parametrize("playing", ["player = play(world='yard', seconds=600)"], indirect=True)
def test_the_pad_on_the_screen_drives_a_robot_that_no_node_drives(playing):
    picture = live(playing)
    button = picture.root.get_by_role("button", name="Forwards")
    button.scroll_into_view_if_needed()
    button.hover()
    playing.page.mouse.down()
    eventually(playing, "way(player) > 0.2")
    playing.page.mouse.up()
    eventually(playing, "sent(player, '/cmd_vel')[1:] == [0.0, 0.0]")
    assert stands(playing)


@pytest.mark.parametrize(
    "playing",
    ["player = play(Process(Teleop, remappings=[('cmd_vel', '/joy_vel')]), world='yard', seconds=600)"],
    indirect=True,
)
def test_keys_drive_through_a_remapping(playing):
    live(playing).canvas.click()
    playing.page.keyboard.down("ArrowUp")
    eventually(playing, "sent(player, '/joy_vel')[1] > 0")
    playing.page.keyboard.up("ArrowUp")
    eventually(playing, "sent(player, '/joy_vel')[1:] == [0.0, 0.0]")
    assert playing.ask("[sent(player, '/cmd_vel')[0], way(player)]") == [0, 0.0]


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_the_buttons_pause_step_speed_up_and_end_the_run(playing):
    picture = live(playing)
    picture.click("Pause")
    picture.wait_until("root => root.innerText.includes('paused')")
    paused = playing.ask("player.recording.stamp")
    begin = playing.ask("time.monotonic()")
    eventually(playing, f"time.monotonic() > {begin} + 0.5")  # the kernel had its turns meanwhile
    assert playing.ask("player.recording.stamp") == paused
    picture.click("One step of 0.05 s")
    eventually(playing, f"abs(player.recording.stamp - {paused} - 0.05) < 0.011")
    picture.click("Go on")
    eventually(playing, f"player.recording.stamp > {paused} + 0.5")
    picture.root.get_by_role("combobox").select_option("4")
    eventually(playing, "player.speed == 4")
    picture.wait_until("root => /runs at [\\d.]+/.test(root.innerText)")
    picture.click("End the run")
    eventually(playing, f"{ENDED}[0] == 'interrupted'")
    assert replay(playing).time() == pytest.approx(playing.ask("player.recording.stamp"), abs=0.01)
    count_becomes(playing.page.locator(".ros2-view.live"), 0)


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_the_stop_button_of_jupyterlab_ends_the_run(playing):
    live(playing).wait_for_time(1.0)
    playing.page.locator("[data-command='notebook:interrupt-kernel']").first.click()
    eventually(playing, f"{ENDED}[0] == 'interrupted'")
    replay(playing).plays()


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_a_cell_run_again_plays_anew_and_alone(playing):
    playing.ask("globals().update(old=player)")
    playing.run_cell(1)
    eventually(playing, "old is not player and old.recording.ended.reason == 'interrupted'")
    live(playing).wait_for_time(0.2)
    assert playing.ask("player.recording.ended.reason") == "running"
    count_becomes(playing.page.locator(".ros2-view"), 1)


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_a_restarted_kernel_plays_again(playing):
    playing.page.evaluate("window.notebook().sessionContext.session.kernel.restart()")
    playing.wait_for_kernel()
    playing.run_cell(0)
    playing.run_cell(1)
    live(playing).wait_for_time(0.5)
    count_becomes(playing.page.locator(".ros2-view.live"), 1)


PLOT = """
import matplotlib.pyplot as plt
plt.plot([pose.x for pose in player.recording.path], [pose.y for pose in player.recording.path])
plt.show()
"""


@pytest.mark.parametrize("playing", [(CIRCLE, PLOT, PLOT)], indirect=True)
def test_plots_appear_in_other_cells_while_it_plays(playing):
    before = playing.ask("player.recording.stamp")
    for index in (2, 3):
        playing.run_cell(index)
        kinds = [set(output.get("data", {})) for output in playing.outputs(index)]
        assert kinds == [{"image/png", "text/plain"}]
    eventually(playing, f"player.recording.stamp > {before} + 0.5")
    assert playing.ask("player.recording.ended.reason") == "running"
    playing.cell(2).evaluate("cell => cell.scrollIntoView({block: 'center'})")
    playing.screenshot("play-and-plot")


@pytest.mark.parametrize("playing", [(CIRCLE, CIRCLE)], indirect=True)
def test_the_robot_plays_beside_the_code_and_the_panel_follows_each_new_play(playing):
    count_becomes(playing.page.locator(".ros2-course-robot .ros2-view.live"), 1)
    count_becomes(playing.page.locator(".jp-Notebook .ros2-view"), 0)
    playing.run_cell(2)
    picture = live(playing)
    picture.wait_for_time(0.2)
    count_becomes(playing.page.locator(".ros2-course-robot"), 1)
    assert picture.root.locator(".how").inner_text().startswith("Click the picture, then drive")
    eventually(playing, "player.recording.ended.reason == 'running'")


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_the_panel_tells_the_robots_numbers_and_what_is_on_a_topic(playing):
    root = live(playing).root
    root.locator("dt", has_text="nearest").wait_for()
    topic = root.locator("button.topic", has_text="/odom")
    topic.click()
    root.locator(".looked pre", has_text="child_frame_id: base_link").wait_for()
    root.locator(".looked canvas[aria-label^='Plot of']").wait_for()
    live(playing).screenshot("play-topic")
    topic.click()
    root.locator(".looked").wait_for(state="hidden")


@pytest.mark.parametrize("playing", ["player = play(world='yard', seconds=600)"], indirect=True)
def test_the_graph_beside_the_topics_changes_as_nodes_come(playing):
    picture = live(playing)
    graph = picture.root.locator(".graph")
    count_becomes(graph.locator("svg"), 0)  # nothing is drawn while no one looks
    graph.locator("summary").press("Space")
    graph.locator("svg text", has_text="/robot").wait_for()
    graph.locator("svg text", has_text="/teleop").wait_for(state="detached")
    picture.canvas.click()
    playing.page.keyboard.down("ArrowUp")
    graph.locator("svg text", has_text="/teleop").wait_for()
    graph.locator(".topic .much", has_text="20 Hz").first.wait_for()
    graph.evaluate("graph => graph.scrollIntoView({block: 'end'})")
    playing.screenshot("play-graph")
    playing.page.keyboard.up("ArrowUp")
    eventually(playing, "sent(player, '/cmd_vel')[1:] == [0.0, 0.0]")
    way = playing.ask("way(player)")
    graph.locator(".wires").press("ArrowDown")  # scrolls, and drives nothing
    assert stands(playing) and playing.ask(f"abs(way(player) - {way}) < 0.3")


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_a_closed_panel_and_a_page_that_is_loaded_again_find_the_robot(playing):
    playing.page.evaluate("window.jupyterapp.shell.collapseRight()")
    playing.page.locator(".ros2-view.live").wait_for(state="hidden")
    playing.page.get_by_role("button", name="Show the robot").click()
    live(playing).wait_for_time(0.5)
    playing.save()
    playing.page.reload()
    playing.wait_for_kernel()
    picture = live(playing)
    picture.wait_for_time(picture.time() + 0.2)
    assert playing.ask("player.recording.ended.reason") == "running"


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_layers_are_switched_on_and_off_below_the_picture(playing):
    root = live(playing).root
    frames = root.get_by_role("button", name="/tf")
    assert frames.get_attribute("aria-pressed") == "false"
    red, green = [201, 42, 42], [43, 138, 62]  # of the axes, which nothing else in a room has
    assert not has_color(live(playing), red)
    frames.click()
    live(playing).wait_until("root => root.querySelector('.layer[aria-pressed=true]')")
    until(lambda: has_color(live(playing), red) and has_color(live(playing), green), "the axes of a frame")
    live(playing).screenshot("play-frames")
    frames.click()
    until(lambda: not has_color(live(playing), red), "a picture without frames")


def has_color(picture: Picture, color: list[int]) -> bool:
    """Whether more than a few pixels of a picture have a color."""
    return picture.canvas.evaluate(
        """(canvas, [red, green, blue]) => {
            const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let count = 0;
            for (let i = 0; i < data.length; i += 4) {
                if (data[i] === red && data[i + 1] === green && data[i + 2] === blue) count++;
            }
            return count > 15;
        }""",
        color,
    )


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_a_chosen_topic_opens_below_the_picture_which_stays_in_sight(playing):
    playing.page.set_viewport_size({"width": 1440, "height": 900})
    root = live(playing).root
    root.locator("button.topic", has_text="/odom").click()
    message = root.locator(".looked pre", has_text="child_frame_id: base_link")
    message.wait_for()
    expect(message).to_be_in_viewport(ratio=0.3, timeout=PATIENCE * 1000)
    expect(root.locator(".looked canvas")).to_be_in_viewport(ratio=1, timeout=PATIENCE * 1000)
    expect(live(playing).canvas).to_be_in_viewport(ratio=1, timeout=PATIENCE * 1000)
    playing.screenshot("play-topic-below-picture")


SHORT = "player = play(Circle, world='room', seconds=3, speed=4)"


@pytest.mark.parametrize("played", [SHORT], indirect=True)
def test_what_is_left_is_a_replay_that_is_saved_and_equal_to_a_run(played):
    replay(played).plays()
    same = "player.recording.digest == run(Circle, world='room', seconds=3, quiet=True).digest"
    assert played.ask(same)
    played.save()
    name = played.page.evaluate("window.notebook().context.path")
    played.shut_down()
    played.open(name)
    replay(played).plays()
    (shown,) = [output["data"] for output in played.outputs(1) if "data" in output]
    assert set(shown) == {"text/html", "text/plain"}
    assert len(shown["text/html"]) < 100 * 1024


@pytest.mark.parametrize("playing", [CIRCLE], indirect=True)
def test_the_live_picture_fits_a_narrow_dark_window(playing):
    with playing.narrow_and_dark():
        picture = live(playing)
        picture.wait_for_time(picture.time() + 0.5)
        box = picture.root.bounding_box()
        assert box["x"] + box["width"] <= 480
        picture.screenshot("play-narrow-dark")
