"""The course's own texts in JupyterLab can be read, light and dark: start page, robot, outputs, Validate."""

from contextlib import nullcontext

import pytest

from tests.browser.contrast import poor_texts
from tests.browser.lab import SHOWN, START, write_notebook
from tests.browser.test_play_in_lab import IMPORTS, live
from tests.browser.test_validate import GRADE

pytestmark = pytest.mark.browser
# Publishes what the panel shows as layers, and a number of its own; it then waits, so that the robot is live.
PLAYED = """
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Float64
class Shows(Node):
    def __init__(self):
        super().__init__("shows")
        self.goal = self.create_publisher(PoseStamped, "/goal_pose", 1)
        self.level = self.create_publisher(Float64, "/level", 1)
        self.create_timer(0.2, self.tick)
    def tick(self):
        goal = PoseStamped()
        goal.header.frame_id, goal.pose.position.x, goal.pose.orientation.w = "map", 1.5, 1.0
        self.goal.publish(goal)
        self.level.publish(Float64(data=self.get_clock().now().nanoseconds / 1e9))
        self.get_logger().warning("low", once=True)
play(Shows, world="room", seconds=600);
"""
FAILS = """
class Fails(Node):
    def __init__(self):
        super().__init__("fails")
        self.create_timer(0.1, self.tick)
    def tick(self):
        1 / 0
run(Fails, seconds=1);
"""
SCORED = "from grader.exercises import nodes\nnodes.counter.grade(Fails)"


@pytest.fixture(scope="module")
def shown(students_folder, open_lab):
    """JupyterLab with a robot that plays, and the outputs of a failure and of a check."""
    write_notebook(students_folder / "contrast/all.ipynb", IMPORTS, PLAYED, FAILS, SCORED)
    with open_lab("contrast/all.ipynb") as lab:
        for index in range(4):
            lab.run_cell(index)
        lab.page.evaluate(GRADE, [3, 5])
        live(lab).wait_for_time(0.5)
        yield lab


def theme(lab, name):
    return lab.dark() if name == "dark" else nullcontext()


@pytest.mark.parametrize("name", ["light", "dark"])
def test_failures_and_scores_can_be_read(shown, name):
    with theme(shown, name):
        shown.page.locator(f"{SHOWN} .ros2-failure code").first.scroll_into_view_if_needed()
        shown.screenshot(f"contrast-outputs-{name}")
        assert shown.page.locator(f"{SHOWN} .ros2-failure code").count() >= 2
        for index in (2, 3):
            cell = f"{SHOWN} [data-windowed-list-index='{index}']"
            assert poor_texts(shown.page, f"{cell} .jp-OutputArea-output") == []


@pytest.mark.parametrize("name", ["light", "dark"])
def test_the_robot_s_panel_can_be_read(shown, name):
    panel = ".ros2-course-robot:not(.lm-mod-hidden)"
    with theme(shown, name):
        topic = shown.page.locator(f"{panel} button.topic", has_text="/level")
        if topic.get_attribute("aria-expanded") == "false":
            topic.click()
        shown.page.locator(f"{panel} .looked pre", has_text="data:").wait_for()
        shown.page.locator(f"{panel} .legend button.layer", has_text="/goal_pose").wait_for()
        shown.screenshot(f"contrast-panel-{name}")
        assert poor_texts(shown.page, ".ros2-course-robots") == []


@pytest.mark.parametrize("name", ["light", "dark"])
def test_the_table_of_validate_can_be_read(shown, name):
    with theme(shown, name):
        shown.page.locator(f"{SHOWN} .validate-button").first.click()
        dialog = shown.page.locator(".jp-Dialog", has_text="Validation Results")
        dialog.locator("tfoot tr").wait_for()
        shown.screenshot(f"contrast-validate-{name}")
        assert poor_texts(shown.page, ".jp-Dialog") == []
        dialog.locator("button.jp-mod-accept").click()


@pytest.mark.parametrize("name", ["light", "dark"])
def test_the_start_page_can_be_read(lab, name):
    lab.open()
    with theme(lab, name):
        lab.page.locator(f"{START} .card").first.wait_for()
        lab.screenshot(f"contrast-start-{name}")
        assert poor_texts(lab.page, START) == []
