"""A replay stays: in the saved notebook, in pages made from it, and as a picture where nothing runs."""

import json
import subprocess
import sys

import pytest

from tests.browser.lab import write_notebook
from tests.browser.pictures import Picture, patient_page, point_at, watch

pytestmark = pytest.mark.browser
CELLS = (
    """
from rclpy.node import Node
from geometry_msgs.msg import Twist

class Circle(Node):
    def __init__(self):
        super().__init__("circle")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.4, 0.5
        self.publisher.publish(twist)
""",
    """
from sim import run
recording = run(Circle, world="room", seconds=20, quiet=True)
recording.replay()
""",
    """
from sim.view import plot_signal
plot_signal(recording, "/cmd_vel", "linear.x", "angular.z")
""",
    """
from IPython.display import HTML
HTML(f'It turned at <a href="#run-{recording.digest[:12]}-3.5">3.5 s</a>.')
""",
)


@pytest.fixture(scope="module")
def saved(browser, students_folder, address, open_lab):
    """A notebook with a replay, run and saved in JupyterLab; its kernel is shut down."""
    path = students_folder / "pictures" / "replay.ipynb"
    write_notebook(path, *CELLS)
    with open_lab("pictures/replay.ipynb") as lab:
        lab.run_all()
        lab.save()
    return path


def check_time_link(picture: Picture) -> None:
    """A time in the text of the page moves the replay there, with the values and messages of that moment."""
    picture.page.get_by_role("link", name="3.5 s").click()
    assert picture.time() == 3.5
    picture.root.locator("button.topic", has_text="/odom").click()
    assert picture.root.locator(".looked pre").inner_text().startswith("# at 3.")
    assert picture.value("v") == "0.40 m/s"
    assert picture.page.locator("a[aria-current='time']").count() == 1
    plot = picture.page.locator(".ros2-time-plot")
    assert plot.locator(".say").inner_text() == "t = 3.50 s"
    point_at(plot, 0.25)
    assert picture.time() == pytest.approx(5.0, abs=0.05)
    picture.scrub(0.5)
    assert plot.locator(".say").inner_text() == f"t = {picture.time():.2f} s"
    assert plot.locator(".u-value").last.inner_text() == "0.5 rad/s"


def test_a_saved_replay_plays_in_lab_without_running_anything(saved, open_lab):
    with open_lab("pictures/replay.ipynb") as lab:
        lab.page.wait_for_selector(".ros2-view canvas")
        picture = Picture(lab.page.locator(".ros2-view:has(.scrub)"))
        picture.plays()
        check_time_link(picture)
        picture.screenshot("replay-lab")


def test_a_notebook_that_is_not_trusted_shows_the_picture(saved, open_lab):
    notebook = json.loads(saved.read_text())
    notebook["cells"][0]["source"] = "# from elsewhere"
    (saved.parent / "untrusted.ipynb").write_text(json.dumps(notebook))
    with open_lab("pictures/untrusted.ipynb") as lab:
        picture = lab.page.locator(".jp-OutputArea-output img[alt='Replay of 20 s']")
        picture.wait_for()
        assert picture.evaluate("image => image.naturalWidth") > 300
        assert lab.page.locator(".ros2-view").count() == 0
        lab.screenshot("replay-untrusted")


def test_an_exported_page_plays_without_internet(saved, browser, tmp_path):
    command = [sys.executable, "-m", "nbconvert", "--to", "html", "--output-dir", str(tmp_path), str(saved)]
    subprocess.run(command, check=True, capture_output=True)
    page = patient_page(browser, offline=True, viewport={"width": 1000, "height": 900})
    requests = watch(page)
    page.goto((tmp_path / "replay.html").as_uri())
    picture = Picture(page.locator(".ros2-view:has(.scrub)"))
    picture.plays()
    check_time_link(picture)
    picture.screenshot("replay-exported")
    # nbconvert's own: for formulas, and for the sliders that a notebook has saved
    own = ("https://cdnjs.cloudflare.com/", "https://unpkg.com/")
    assert all(url.startswith(("file:", "data:", *own)) for url in requests)
    page.close()


def test_a_replay_fits_a_narrow_dark_window(saved, open_lab):
    with open_lab("pictures/replay.ipynb") as lab, lab.narrow_and_dark():
        picture = Picture(lab.page.locator(".ros2-view:has(.scrub)"))
        picture.plays()
        box = picture.root.bounding_box()
        assert box["x"] + box["width"] <= 480
        picture.screenshot("replay-narrow-dark")
