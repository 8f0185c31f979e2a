import base64
import dataclasses
import json
import math
import re
import zlib
from html.parser import HTMLParser

import numpy as np
import pytest
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

from sim import Recording, World, run
from sim.evidence import CallbackError, Ended, LogLine, Message, Pose
from sim.ros.messages.codec import encode
from sim.view import plot_graph, replay, replay_data
from sim.view.interactive import PLAYER_SCRIPT, PLAYER_SOURCE
from sim.world import Contact
from tests.bench.avoider import Avoider
from tests.sim.recordings import driven, recording
from tests.sim.view.worlds import CROWDED
from tests.students import misfits


@pytest.fixture(scope="module")
def drive():
    return run(Avoider, world="room", seconds=20, quiet=True)


class Parts(HTMLParser):
    """The tags of a page, and the text of its scripts."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.script = [], ""
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.script += data


def parts(recording, **options):
    return Parts(replay(recording, **options).html)


def unpacked(recording):
    """What the page's script finds in the data."""
    packed = base64.b64decode(replay_data.pack(recording, 1.0), validate=True)
    return json.loads(zlib.decompress(packed, -15))


def summed(differences):
    return np.cumsum(differences)


def test_a_replay_is_inert_data_with_a_picture_and_a_constant_script(drive):
    page = parts(drive)
    (div, data), (img, picture), (script, _) = page.tags
    assert (div, img, script) == ("div", "img", "script")
    assert data["class"] == "ros2-replay"
    assert re.fullmatch(r"[A-Za-z0-9+/]+={0,2}", data["data-replay"])
    assert base64.b64decode(picture["src"].removeprefix("data:image/png;base64,")).startswith(b"\x89PNG")
    assert picture["alt"] == "Replay of 20 s"
    assert page.script == PLAYER_SCRIPT


def test_a_page_needs_nothing_from_elsewhere():
    assert re.findall(r"https?://[^\s\"']*|import\s|fetch\(|innerHTML|eval\(", PLAYER_SOURCE) == [
        "http://www.w3.org/2000/svg"  # a name, no address: nothing is loaded
    ] * PLAYER_SOURCE.count("http://www.w3.org/2000/svg")
    (data,) = re.findall(r'atob\("([^"]*)"\)', PLAYER_SCRIPT)
    assert PLAYER_SOURCE in zlib.decompress(base64.b64decode(data), -15).decode()


def test_twenty_seconds_with_a_lidar_are_less_than_100_kib(drive):
    assert len(replay(drive).html.encode()) < 100 * 1024


def test_ten_minutes_are_hardly_larger(drive):
    def on(items):
        return [item._replace(stamp=item.stamp + 20 * turn) for turn in range(30) for item in items]

    ended = Ended("time", 600.0, "")
    long = dataclasses.replace(drive, path=on(drive.path), published=on(drive.published), ended=ended)
    assert len(replay(long).html.encode()) < 150 * 1024


def test_equal_recordings_give_equal_bytes(drive):
    again = run(Avoider, world="room", seconds=20, quiet=True)
    assert replay(drive).html == replay(again).html


def test_a_recording_has_its_replay_and_a_notebook_shows_it(drive):
    shown = drive.replay(speed=2.0)
    assert shown._repr_html_() == replay(drive, speed=2.0).html
    assert shown._repr_mimebundle_() == {"text/html": shown.html, "text/plain": repr(shown)}
    assert re.fullmatch(r"<Replay of 20 s: \d+ KiB>", repr(shown))


def test_poses_and_scans_are_where_they_were_to_the_millimeter(drive):
    data = unpacked(drive)
    ((xs, ys, yaws),) = data["tracks"]
    assert summed(data["stamps"]) / 1000 == pytest.approx([pose.stamp for pose in drive.path])
    assert summed(xs) / 1000 == pytest.approx([pose.x for pose in drive.path], abs=5.1e-4)
    assert summed(ys) / 1000 == pytest.approx([pose.y for pose in drive.path], abs=5.1e-4)
    assert summed(yaws) / 1000 == pytest.approx([pose.yaw for pose in drive.path], abs=5.1e-4)
    scan = data["scans"][100]
    at = next(pose for pose in drive.path if abs(pose.stamp - scan["stamp"] / 1000) < 1e-6)
    assert scan["pose"] == pytest.approx(at[1:], abs=5.1e-4)
    received = next(h for h in drive.messages("/scan") if round(h.stamp * 1000) == scan["stamp"]).message
    stride = round(scan["step"] / received.angle_increment)
    for reported, true in zip(summed(scan["ranges"]), received.ranges[::stride], strict=True):
        assert reported * 0.02 == pytest.approx(true, abs=0.011) if math.isfinite(true) else reported == -1


def test_a_ray_without_a_measurement_differs_from_one_out_of_range():
    ranges = [math.inf, -math.inf, math.nan, 0.5]
    received = Message(0.0, "/scan", "sensor_msgs/msg/LaserScan", "/robot", encode(LaserScan(ranges=ranges)))
    (scan,) = unpacked(driven([(0, 0), (1, 0)], published=[received]))["scans"]
    assert list(summed(scan["ranges"])) == [-1, -2, -2, 25]


def test_rays_are_drawn_from_where_the_lidar_sits():
    room = World.load("room")
    world = dataclasses.replace(room, lidar=dataclasses.replace(room.lidar, x=0.05, yaw=math.pi / 2))
    received = Message(0.0, "/scan", "sensor_msgs/msg/LaserScan", "/robot", encode(LaserScan(ranges=[1.0])))
    recording = dataclasses.replace(driven([(0, 0), (1, 0)], published=[received]), world=world)
    (scan,) = unpacked(recording)["scans"]
    assert scan["pose"] == [0.05, 0.0, 1.571]


def test_scans_of_a_students_node_are_not_the_robots():
    received = Message(0.0, "/scan", "sensor_msgs/msg/LaserScan", "/mapper", encode(LaserScan(ranges=[1.0])))
    assert unpacked(driven([(0, 0), (1, 0)], published=[received]))["scans"] == []


def test_a_scan_without_sense_is_left_out():
    odd = [LaserScan(), LaserScan(ranges=[1.0], angle_min=math.nan)]
    odd.append(LaserScan(ranges=[1.0], range_max=math.inf))
    received = [Message(0.0, "/scan", "sensor_msgs/msg/LaserScan", "/robot", encode(scan)) for scan in odd]
    assert unpacked(driven([(0, 0), (1, 0)], published=received))["scans"] == []


def test_scans_that_no_page_could_draw_are_left_out_or_cut():
    """A student's node may have the robot's name, and send anything."""

    def received(stamp, raw):
        return Message(stamp, "/scan", "sensor_msgs/msg/LaserScan", "/robot", raw)

    far = LaserScan(ranges=[1e30, -1.0], range_max=3.5)
    lost = LaserScan(ranges=[1.0], angle_min=1e30, range_max=1.0)
    scans = [received(0.0, b"no scan"), received(0.2, encode(lost)), received(0.4, encode(far))]
    (kept,) = unpacked(driven([(0, 0), (1, 0)], published=scans))["scans"]
    assert list(summed(kept["ranges"])) == [replay_data.FAR / replay_data.RANGE_UNIT, 0]


def test_other_robots_boxes_and_machines_have_tracks(drive):
    data = unpacked(run(world=CROWDED, seconds=1, quiet=True))
    assert [body["name"] for body in data["world"]["bodies"]] == ["robot", "leader", "box_1"]
    assert [[column[0] for column in track] for track in data["tracks"]] == [
        [0, 0, 0],
        [1000, -1000, 0],
        [1000, 1000, 0],
    ]
    arm = unpacked(run(world="arm", seconds=1, quiet=True))
    assert [body["kind"] for body in arm["world"]["bodies"]] == ["link", "link"]
    assert len(arm["tracks"]) == 2


def test_marks_describe_what_happened_when():
    touch = Contact(3.2, 3.4, 1.0, 2.0, "front", "wall")
    error = CallbackError(4.0, "/driver", "Driver.tick", "KeyError", "'x'", "")
    silent = CallbackError(4.5, "/driver", "Driver.tick", "NotImplementedError", "", "")
    data = unpacked(driven([(0, 0)] * 6, contacts=[touch], errors=[error, silent]))
    assert data["marks"] == [
        [3200, "contact", "t = 3.2 s: touched a wall with its front", [1.0, 2.0]],
        [4000, "error", "t = 4 s: KeyError in Driver.tick: 'x'", None],
        [4500, "error", "t = 4.5 s: NotImplementedError in Driver.tick", None],
        [5000, "end", "t = 5 s: the run ended. All of it was run.", None],
    ]


def test_the_graph_at_the_end_is_there(drive):
    graph = unpacked(drive)["graph"]
    assert graph["words"] == plot_graph(drive).description
    assert unpacked(Recording(stamp=1.0))["graph"] is None


def test_log_lines_and_topics_are_there():
    recording = run(misfits.Talker, misfits.Listener, seconds=4, quiet=True)
    data = unpacked(recording)
    assert (data["world"], data["tracks"], data["stamps"]) == (None, [], [])
    assert data["logs"][0] == [1000, "INFO", f"{recording.logs[0].node}: {recording.logs[0].text}", None]
    ((name, reported, strip),) = data["topics"]
    assert (name, reported, len(strip), strip.count("1")) == ("/chatter", "1 Hz", replay_data.COLUMNS, 4)


def test_marks_lines_and_text_are_bounded():
    errors = [CallbackError(n / 1000, "/a", "A.tick", "E", "x" * 999, "") for n in range(5000)]
    logs = [LogLine(n / 1000, "INFO", "a", "y" * 999) for n in range(5000)]
    data = unpacked(recording(errors=errors, logs=logs))
    assert (len(data["marks"]), len(data["logs"])) == (replay_data.MARKS + 1, replay_data.LOGS)
    assert max(len(event[2]) for event in data["marks"] + data["logs"]) < replay_data.CHARACTERS + 20


def test_of_long_texts_there_are_few():
    """Signs that no packing makes smaller take no more than the picture of the world does."""
    logs = [
        LogLine(n / 10, "INFO", "a", "".join(chr(0x3400 + n * k % 9973) for k in range(190)))
        for n in range(300)
    ]
    data = unpacked(recording(logs=logs))
    assert 10 < len(data["logs"]) < 60
    assert (data["logs"][0][0], data["logs"][-1][0]) == (0, 29900)
    assert len(replay_data.pack(recording(logs=logs), 1.0)) < 20_000


@pytest.mark.parametrize("many, kept", [(3, [0, 1, 2]), (100, [0, 33, 66, 99])])
def test_thinning_retains_first_and_last(many, kept):
    assert replay_data.thinned(range(many), 4) == kept


@pytest.mark.parametrize("speed", [0, -1.0, math.nan, math.inf])
def test_a_speed_must_be_above_0(speed):
    with pytest.raises(ValueError) as caught:
        replay(Recording(), speed=speed)
    assert str(caught.value) == f"speed must be a number above 0; it is {speed!r}"


def test_a_world_in_which_nothing_moved_yet_is_refused():
    with pytest.raises(ValueError, match=r"^nothing has moved in this run yet: it has no pose to draw$"):
        replay(Recording(world=World.load("room")))


def test_a_run_that_was_stopped_at_once_has_a_replay():
    stopped = Recording(
        world=World.load("room"), path=[Pose(0.0, 0.0, 0.0, 0.0)], ended=Ended("interrupted", 0.0, "Stopped.")
    )
    assert unpacked(stopped)["end"] == 0.0


class Tricky(Node):
    def __init__(self):
        super().__init__("tricky")
        self.get_logger().info("</script><script>alert(1)</script>")


def test_text_of_a_run_is_never_in_the_page_unescaped():
    assert "alert" not in replay(run(Tricky, seconds=1, quiet=True)).html
