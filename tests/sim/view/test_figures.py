import dataclasses
import io
import subprocess
import sys

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from matplotlib.figure import Figure
from nav_msgs.msg import Odometry
from PIL import Image
from sensor_msgs.msg import Imu, JointState, LaserScan, Temperature
from std_msgs.msg import Float64, String

from sim import Recording, World, run
from sim.evidence import CallbackError, Pose
from sim.view import animate, plot_path, plot_signal, plot_topics, png
from tests.patience import PATIENCE
from tests.sim import recordings
from tests.sim.recordings import published
from tests.sim.view.worlds import CROWDED
from tests.students import misfits
from tests.students.engine import actions, goals, services

JOINT = ("/joint_states", "position.1")


def driven(world="room", **evidence):
    return recordings.driven([(0.2 * n, 0.0) for n in range(6)], world=world, **evidence)


def labels(figure):
    return figure.axes[0].get_legend_handles_labels()[1]


def test_the_path_is_drawn_in_meters_over_the_world():
    figure = plot_path(driven())
    axes = figure.axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == (
        "x (m)",
        "y (m)",
        "room, seen from above",
    )
    assert axes.get_aspect() == 1.0
    way = next(line for line in axes.lines if line.get_label() == "path")
    assert way.get_xdata() == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert labels(figure) == ["goal", "path", "start", "end, 5 s"]


def test_walls_boxes_and_pillars_are_where_they_are():
    world = World.load("room")
    axes = plot_path(driven()).axes[0]
    assert len(axes.collections[0].get_segments()) == len(world.walls)
    assert len(axes.patches) == len(world.boxes) + len(world.circles) + 2  # and the robot at both ends


def test_a_machine_is_drawn_at_start_and_end():
    """The upper arm is 0.5 m long and 0.06 m wide; at last both links point up."""
    up = [Pose(2.0, 0.0, 0.0, np.pi / 2), Pose(2.0, 0.0, 0.5, np.pi / 2)]
    tracks = {"upper_arm": [Pose(0.0, 0.0, 0.0, 0.0), up[0]], "forearm": [Pose(0.0, 0.5, 0.0, 0.0), up[1]]}
    figure = plot_path(Recording(world=World.load("arm"), tracks=tracks))
    assert (figure.axes[0].get_title(), labels(figure)) == ("arm", ["start", "end, 2 s", "tip's path"])
    (tip,) = figure.axes[0].lines
    assert tip.get_xydata() == pytest.approx(np.array([(0.9, 0.0), (0.0, 0.9)]))
    corners = figure.axes[0].patches[2].get_xy()[:4]  # behind the base and the upper arm's start
    assert corners == pytest.approx(
        np.array([(0.03, -0.03), (0.03, 0.53), (-0.03, 0.53), (-0.03, -0.03)]), abs=1e-9
    )
    assert len(figure.axes[0].patches) == 1 + 2 * 2


def test_boxes_and_other_robots_are_drawn_beside_the_robot():
    tracks = {"box_1": [Pose(0.0, 1.0, 1.0, 0.0)], "leader": [Pose(0.0, 1.0, -1.0, 0.0)]}
    figure = plot_path(dataclasses.replace(driven(), world=CROWDED, tracks=tracks))
    assert len(figure.axes[0].patches) == 2 * 3  # each at both ends
    assert labels(figure) == ["path", "start", "end, 5 s", "leader"]


def test_contacts_are_marked():
    figure = plot_path(driven(contacts=[(1.0, None, 3.0, 0.5, "front", "wall")]))
    marks = next(line for line in figure.axes[0].lines if line.get_label() == "contact")
    assert (list(marks.get_xdata()), list(marks.get_ydata())) == ([3.0], [0.5])


def test_a_path_that_leaves_the_world_stays_in_the_picture():
    recording = driven("yard")
    recording.path.append(Pose(6.0, 9.0, -8.0, 0.0))
    axes = plot_path(recording).axes[0]
    assert axes.get_xlim()[1] > 9.0 > -8.0 > axes.get_ylim()[0]


@pytest.mark.parametrize("draw", [plot_path, animate])
def test_a_run_without_a_robot_is_refused(draw):
    with pytest.raises(
        ValueError, match=r'^this run has no robot to draw: give run\(\) a world, such as world="yard"$'
    ):
        draw(Recording())


def test_an_animation_shows_a_machine_too():
    turn = [Pose(stamp, 0.0, 0.0, stamp) for stamp in (0.0, 1.0)]
    recording = Recording(world=World.load("joint"), tracks={"link": turn})
    moving = Image.open(io.BytesIO(bytes(animate(recording))))
    first = np.asarray(moving.convert("RGB"), dtype=int)
    moving.seek(moving.n_frames - 1)
    last = np.asarray(moving.convert("RGB"), dtype=int)
    assert (np.abs(first - last)[40:].sum(axis=2) > 60).sum() > 100  # below the clock


def test_topics_have_a_row_each_with_count_and_rate():
    recording = run(misfits.Talker, misfits.Listener, seconds=5, quiet=True)
    recording.errors.append(CallbackError(2.5, "/talker", "Talker.tick", "KeyError", "", ""))
    axes = plot_topics(recording).axes[0]
    assert [tick.get_text() for tick in axes.get_yticklabels()] == [
        "/chatter\n5, 1 Hz",
        "log lines\n5",
        "errors",
    ]
    assert axes.get_xlabel() == "time (s)"
    assert list(axes.lines[0].get_xdata()) == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert list(axes.lines[2].get_xdata()) == [2.5]


def test_services_and_actions_have_rows_too():
    recording = run(services.SlowAdder, services.many_calls, goals.two_servers, actions.Client, seconds=4)
    axes = plot_topics(recording).axes[0]
    labels = [tick.get_text() for tick in axes.get_yticklabels()]
    assert labels[:2] == ["/add\n5 calls", "/fibonacci\n2 goals"]
    assert list(axes.lines[0].get_xdata()) == [0.0] * 5
    assert list(axes.lines[1].get_xdata()) == [0.0] * 6


def test_topics_can_be_chosen():
    recording = published("/chatter", [(1.0, String())])
    axes = plot_topics(recording, ["/news", "/chatter"]).axes[0]
    assert [tick.get_text() for tick in axes.get_yticklabels()] == ["/news\n0", "/chatter\n1"]


def test_an_empty_run_has_an_empty_timeline():
    assert plot_topics(Recording()).axes[0].lines[:] == []


def commands():
    messages = [(float(n), Twist()) for n in range(4)]
    for n, (_, message) in enumerate(messages):
        message.linear.x, message.angular.z = 0.1 * n, -0.5
    return published("/cmd_vel", messages)


def test_signals_are_drawn_over_time_with_their_unit():
    axes = plot_signal(commands(), "/cmd_vel", "linear.x", "angular.z", unit="m/s, rad/s").axes[0]
    assert (axes.get_title(), axes.get_xlabel(), axes.get_ylabel()) == ("/cmd_vel", "time (s)", "m/s, rad/s")
    assert list(axes.lines[0].get_xdata()) == [0.0, 1.0, 2.0, 3.0]
    assert axes.lines[0].get_ydata() == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert [line.get_label() for line in axes.lines] == ["linear.x", "angular.z"]


def test_the_line_of_a_signal_is_broken_where_the_topic_is_silent():
    moments = [0.0, 0.1, 0.2, 0.3, 0.9, 1.0]
    figure = plot_signal(published("/n", [(moment, Float64(data=moment)) for moment in moments]), "/n")
    drawn = figure.axes[0].lines[0].get_ydata()
    assert [str(value) for value in drawn] == ["0.0", "0.1", "0.2", "0.3", "nan", "0.9", "1.0"]


@pytest.mark.parametrize(
    "topic, kind, fields, unit",
    [
        ("/cmd_vel", Twist, ("linear.x", "angular.z"), "m/s, rad/s"),
        ("/odom", Odometry, ("pose.pose.position.x",), "m"),
        ("/odom", Odometry, ("pose.pose.orientation.w",), ""),
        ("/imu", Imu, ("linear_acceleration.x",), "m/s²"),
        ("/scan", LaserScan, ("ranges.0",), "m"),
        ("/temperature", Temperature, ("temperature", "variance"), "°C"),
        ("/joint_states", JointState, ("position.1",), ""),
    ],
)
def test_units_are_those_that_ros_gives_to_the_fields(topic, kind, fields, unit):
    message = kind()
    for name in {"ranges", "position"} & set(kind.get_fields_and_field_types()):
        setattr(message, name, [1.0, 2.0])
    assert plot_signal(published(topic, [(1.0, message)]), topic, *fields).axes[0].get_ylabel() == unit


def test_an_item_of_a_list_is_a_signal():
    axes = plot_signal(published("/joint_states", [(1.0, JointState(position=[0.5, 2.0]))]), *JOINT).axes[0]
    assert list(axes.lines[0].get_ydata()) == [2.0]


def test_each_joint_that_has_a_place_in_the_messages_has_a_line():
    rows = [(0.0, "arm", 0.1), (0.1, "gripper", 0.9), (0.2, "arm", 0.2), (0.3, "gripper", 0.8)]
    states = [(stamp, JointState(name=[name], position=[value])) for stamp, name, value in rows]
    axes = plot_signal(published("/joint_states", states), "/joint_states", "position.0", unit="rad").axes[0]
    shown = {line.get_label(): list(line.get_ydata()) for line in axes.lines}
    assert shown == {"arm position": [0.1, 0.2], "gripper position": [0.9, 0.8]}


def test_an_item_that_is_not_there_is_refused():
    with pytest.raises(ValueError, match=r"^the messages on /joint_states have no field position\.1; "):
        plot_signal(published("/joint_states", [(1.0, JointState(position=[0.5]))]), *JOINT)


@pytest.mark.parametrize(
    "topic, fields, sentence",
    [
        ("/odom", (), "there are no messages on /odom to draw; this run has /cmd_vel"),
        ("/cmd_vel", ("speed",), "the messages on /cmd_vel have no field speed; they have linear, angular"),
        ("/cmd_vel", ("linear",), "linear on /cmd_vel is not a number, but Vector3"),
        ("/cmd_vel", (), "the messages on /cmd_vel have no field data; they have linear, angular"),
    ],
)
def test_what_is_no_signal_is_refused(topic, fields, sentence):
    with pytest.raises(ValueError) as caught:
        plot_signal(commands(), topic, *fields)
    assert str(caught.value) == sentence


def test_text_is_no_signal():
    with pytest.raises(ValueError, match=r"^data on /chatter is not a number, but str$"):
        plot_signal(published("/chatter", [(1.0, String())]), "/chatter")


def test_a_figure_shows_itself_and_equal_figures_have_equal_bytes():
    first, second = plot_path(driven()), plot_path(driven())
    assert isinstance(first, Figure)
    assert first._repr_png_()[0] == png(second)
    assert Image.open(io.BytesIO(png(first))).size == (640, 480)


def test_the_students_own_matplotlib_is_left_alone():
    program = """
import sys
from sim.view import plot_topics, png
from sim import Recording
png(plot_topics(Recording()))
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=PATIENCE)


def test_the_animation_shows_the_robot_on_its_path():
    moving = Image.open(io.BytesIO(bytes(animate(driven(), speed=1.0, frames_per_second=2))))
    assert (moving.n_frames, moving.format) == (11, "PNG")
    moving.seek(0)
    first = np.asarray(moving.convert("RGB"), dtype=int)
    moving.seek(10)
    last = np.asarray(moving.convert("RGB"), dtype=int)
    changed = np.argwhere(np.abs(first - last).sum(axis=2) > 60)
    height, width = first.shape[:2]
    below_clock = changed[changed[:, 0] > 30]
    assert len(below_clock) > 50
    assert np.ptp(below_clock[:, 1]) > 0.1 * width  # along x by a meter
    assert np.ptp(below_clock[:, 0]) < 0.1 * height  # and not along y


def test_an_animation_of_twenty_seconds_is_small_and_always_the_same():
    recording = run(misfits.Talker, world="room", seconds=20, quiet=True)
    recording.path = [
        pose._replace(x=2 * np.cos(pose.stamp), y=2 * np.sin(pose.stamp)) for pose in recording.path
    ]
    moving = animate(recording)
    assert len(bytes(moving)) < 200_000
    assert bytes(moving) == bytes(animate(recording))
    assert repr(moving) == "<MovingPicture of 20 s>"
    assert moving.html == animate(recording).html
    assert len(moving.html) < 80_000


@pytest.mark.parametrize("pace", [{"speed": 0}, {"frames_per_second": -1}])
def test_an_animation_needs_a_speed(pace):
    with pytest.raises(ValueError, match=r"^speed and frames_per_second must be above 0$"):
        animate(driven(), **pace)
