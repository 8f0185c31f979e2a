"""The world turtlesim: its names, its words and how its turtles move, as upstream's."""

import math

import pytest

from sim import Recording, World, run
from sim.world import PenDrawing
from tests.sim.ros.evidence import logged
from tests.students.engine.pond import script

MIDDLE, SIDE = 5.544444561004639, 11.088889122009277
BLUE, PEN, BLACK = (69, 86, 255), (179, 184, 255), (0, 0, 0)
TURTLE1 = "Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]"


def in_pond(*steps, seconds=4.0):
    recording = run(script(*steps), world="turtlesim", seconds=seconds, quiet=True)
    assert (recording.ended.reason, recording.errors, recording.course_errors) == ("time", [], [])
    return recording


def news(recording, levels=("INFO", "WARN", "ERROR")):
    """What was logged after the beginning: (stamp, text)."""
    return [(line.stamp, line.text) for line in recording.logs[2:] if line.level in levels]


def colors(recording):
    """What turtle1 saw beneath itself: (stamp, color) whenever that changed."""
    seen = []
    for received in recording.messages("/turtle1/color_sensor"):
        color = received.message.r, received.message.g, received.message.b
        if not seen or seen[-1][1] != color:
            seen.append((received.stamp, color))
    return seen


def ended(recording):
    """(status, stamp of the end, delta) of each goal."""
    return [(goal.status, goal.ended, pytest.approx(goal.result.delta)) for goal in recording.goals]


@pytest.fixture(scope="module")
def ahead():
    """1 m/s for as long as one command holds."""
    return in_pond((1.0, "swim", "turtle1", 1.0))


def test_names_and_types_are_upstreams(ahead):
    ends = {(end.kind, end.name): end.type for end in ahead.graph.endpoints if end.node == "/turtlesim"}
    own = {key: kind for key, kind in ends.items() if not kind.startswith("rcl_interfaces/")}
    assert own == {
        ("subscription", "/turtle1/cmd_vel"): "geometry_msgs/msg/Twist",
        ("publisher", "/turtle1/pose"): "turtlesim/msg/Pose",
        ("publisher", "/turtle1/color_sensor"): "turtlesim/msg/Color",
        ("service", "/clear"): "std_srvs/srv/Empty",
        ("service", "/reset"): "std_srvs/srv/Empty",
        ("service", "/spawn"): "turtlesim/srv/Spawn",
        ("service", "/kill"): "turtlesim/srv/Kill",
        ("service", "/turtle1/set_pen"): "turtlesim/srv/SetPen",
        ("service", "/turtle1/teleport_absolute"): "turtlesim/srv/TeleportAbsolute",
        ("service", "/turtle1/teleport_relative"): "turtlesim/srv/TeleportRelative",
        ("action server", "/turtle1/rotate_absolute"): "turtlesim/action/RotateAbsolute",
    }
    assert logged(ahead) == [(0.0, "Starting turtlesim with node name /turtlesim"), (0.0, TURTLE1)]


def test_a_turtle_waits_in_the_middle_and_tells_so_every_16_ms(ahead):
    received = ahead.messages("/turtle1/pose")
    assert [item.stamp for item in received] == [pytest.approx(0.016 * tick) for tick in range(1, 251)]
    first = received[0].message
    assert (first.x, first.y, first.theta) == (MIDDLE, MIDDLE, 0.0)
    assert ahead.path[0] == (0.0, MIDDLE, MIDDLE, 0.0)


def test_a_command_holds_for_a_second(ahead):
    received = ahead.messages("/turtle1/pose")
    moving = [item.stamp for item in received if item.message.linear_velocity == 1.0]
    assert (moving[0], moving[-1], len(moving)) == (1.008, 2.0, 63)
    assert ahead.path[-1][1:] == pytest.approx((MIDDLE + 63 * 0.016, MIDDLE, 0.0))


def test_a_circle_wraps_around_and_theta_stays_within_pi():
    recording = in_pond(*((0.5 * n, "swim", "turtle1", 2.0, 0.0, 1.8) for n in range(1, 8)))
    angles = [received.message.theta for received in recording.messages("/turtle1/pose")]
    assert -math.pi <= min(angles) < -3.1 and 3.1 < max(angles) <= math.pi


def test_at_the_edge_a_turtle_stops_and_says_so_at_each_step():
    recording = in_pond((0.5, "swim", "turtle1", 10.0), seconds=1.1)
    assert news(recording) == [
        (1.056, "Oh no! I hit the wall! (Clamping from [x=11.144445, y=5.544445])"),
        (1.072, "Oh no! I hit the wall! (Clamping from [x=11.248889, y=5.544445])"),
        (1.088, "Oh no! I hit the wall! (Clamping from [x=11.248889, y=5.544445])"),
    ]
    assert {line.level for line in recording.logs[2:]} == {"WARN"}
    assert recording.path[-1][1:] == (SIDE, MIDDLE, 0.0)


def test_turtles_come_and_go():
    recording = in_pond(
        (0.5, "spawn"), (0.6, "spawn"), (0.7, "spawn", "turtle2"), (0.8, "kill", "absent"),
        (0.9, "kill", "turtle2"), (1.0, "spawn", "my turtle"), (1.1, "spawn", "nemo"),
        (1.2, "reset"), (1.4, "spawn"), seconds=2,
    )  # fmt: skip
    spawning = "Spawning turtle [{}] at x=[2.000000], y=[2.000000], theta=[0.200000]"
    assert news(recording) == [
        (0.5, spawning.format("turtle2")),
        (0.5, "Its name is 'turtle2'"),
        (0.6, spawning.format("turtle3")),
        (0.6, "Its name is 'turtle3'"),
        (0.7, "A turtle named [turtle2] already exists"),
        (0.7, "Its name is ''"),
        (0.8, "Tried to kill turtle [absent], which does not exist"),
        (1.0, "A turtle can't be named [my turtle]: write letters, digits and _, and begin with a letter"),
        (1.0, "Its name is ''"),
        (1.1, spawning.format("nemo")),
        (1.1, "Its name is 'nemo'"),
        (1.2, "Resetting turtlesim."),
        (1.2, TURTLE1),
        (1.4, spawning.format("turtle2")),
        (1.4, "Its name is 'turtle2'"),
    ]
    assert [body.name for body in recording.bodies] == ["turtle1", "turtle2", "turtle3", "nemo"]
    stamps = [pose.stamp for pose in recording.tracks["turtle2"]]
    assert (stamps[0], stamps[-1]) == pytest.approx((0.528, 1.968))
    assert not any(0.91 < stamp < 1.4 for stamp in stamps)
    assert 0 < len(recording.messages("/nemo/pose")) < 8


def test_a_rotation_goes_at_1_rad_per_s_and_tells_what_remains():
    recording = in_pond((0.5, "rotate", "turtle1", 1.0), seconds=2)
    (goal,) = recording.goals
    remaining = [received.message.remaining for received in goal.feedback]
    assert remaining == pytest.approx([1.0 - 0.016 * step for step in range(63)])
    assert ended(recording) == [("succeeded", 1.504, -0.992)]
    assert news(recording) == [(1.504, "Rotation goal completed successfully")]


def test_what_ends_a_rotation_early():
    recording = in_pond(
        (0.5, "rotate", "turtle1", 3.0), (1.0, "rotate", "turtle1", -1.0), (1.5, "swim", "turtle1", 1.0),
        (2.0, "rotate", "turtle1", 2.0), (2.2, "cancel"), (3.0, "rotate", "turtle1", math.nan), seconds=3.5,
    )  # fmt: skip
    assert news(recording) == [
        (1.0, "Rotation goal received before a previous goal finished. Aborting previous goal"),
        (1.5, "Velocity command received during rotation goal. Aborting goal"),
        (2.208, "Rotation goal canceled"),
        (3.0, "Headings are finite numbers; this one was nan: check how it was calculated."),
    ]
    assert [goal.status for goal in recording.goals] == ["aborted", "aborted", "canceled", "rejected"]


def test_a_turtle_that_is_killed_turns_no_more_and_its_name_can_be_had_again():
    recording = in_pond(
        (0.5, "spawn"), (0.6, "rotate", "turtle2", 3.0), (1.0, "kill", "turtle2"), (1.5, "spawn", "turtle2"),
        (1.6, "rotate", "turtle2", 0.1), seconds=2,
    )  # fmt: skip
    assert ended(recording) == [("aborted", 1.0, -0.384), ("succeeded", 1.712, 0.096)]


def test_teleporting_draws_a_line_with_the_pen_that_is_down():
    recording = in_pond(
        (0.5, "jump_to", 1.0, 1.0, 0.0), (1.0, "jump", 2.0, math.pi / 2), (1.5, "pen"),
        (1.6, "jump_to", 9.0, 9.0, 0.0), (2.0, "jump", 20.0, 0.0), seconds=2.5,
    )  # fmt: skip
    strokes = recording.drawing.strokes
    points = [[(round(x, 3), round(y, 3)) for _, x, y in stroke.points[:3]] for stroke in strokes]
    drawn = [
        (stroke.color, round(stroke.width * 45), line) for stroke, line in zip(strokes, points, strict=True)
    ]
    assert drawn == [
        (PEN, 3, [(5.544, 5.544), (1.0, 1.0), (1.0, 3.0)]),
        (BLACK, 1, [(1.0, 3.0), (9.0, 9.0), (11.089, 9.0)]),
    ]
    assert news(recording) == [(2.016, "Oh no! I hit the wall! (Clamping from [x=29.000000, y=2.088889])")]


def test_a_lifted_pen_draws_nothing_and_another_one_draws():
    recording = in_pond(
        (0.2, "lift"), (0.3, "swim", "turtle1", 1.0), (0.8, "pen", 255, 0, 9), (0.9, "swim", "turtle1", 0.0),
        seconds=1,
    )  # fmt: skip
    (stroke,) = recording.drawing.strokes
    assert (stroke.color, stroke.points[0][0]) == ((255, 0, 9), pytest.approx(0.816))


def test_the_color_beneath_is_that_of_the_pond_or_of_a_line():
    recording = in_pond(
        (0.5, "swim", "turtle1", 1.0), (1.0, "set", "background_r", 150), (1.1, "set", "background_g", 300),
        (1.2, "clear"), seconds=1.5,
    )  # fmt: skip
    assert colors(recording)[:2] == [(0.016, BLUE), (0.528, PEN)]
    assert recording.drawing.grounds == [(0.0, BLUE), (1.0, (150, 86, 255))]
    assert news(recording) == [
        (1.0, "Set: True"),
        (1.1, "Set: False Parameter background_g out of range. Min: 0, Max: 255, value: 300"),
        (1.2, "Clearing turtlesim."),
    ]
    first, second = recording.drawing.strokes
    assert (first.erased, second.erased) == (1.2, None)
    assert [stroke for stroke, _ in recording.drawing.at(1.1)] == [first]


def test_with_holonomic_a_turtle_moves_sideways():
    recording = in_pond(
        (0.2, "swim", "turtle1", 0.0, 1.0), (1.5, "set", "holonomic", True),
        (2.0, "swim", "turtle1", 0.0, 1.0), seconds=3.5,
    )  # fmt: skip
    assert recording.pose_at(1.5)[1:3] == (MIDDLE, MIDDLE)
    assert recording.path[-1][1:3] == pytest.approx((MIDDLE, MIDDLE + 62 * 0.016))


def test_numbers_that_are_none_are_refused():
    recording = in_pond(
        (0.5, "jump", math.inf, 0.0), (0.6, "jump_to", 0.0, math.nan, 0.0),
        (1.7, "swim", "turtle1", math.nan), (1.8, "odd"), seconds=2,
    )  # fmt: skip
    assert news(recording, ["ERROR"]) == [
        (0.5, "Places are finite numbers; this one was inf, 0: check how it was calculated."),
        (1.7, "Velocity commands are finite numbers; this one was nan, 0, 0: check how it was calculated."),
        (1.8, "Places are finite numbers; this one was nan, 2, 0.2: check how it was calculated."),
    ]
    assert recording.path[-1][1:] == (MIDDLE, MIDDLE, 0.0)


def test_a_recording_comes_back_from_its_file_with_what_was_drawn(tmp_path, ahead):
    again = Recording.load(ahead.save(tmp_path / "pond.mcap"))
    assert again.drawing == ahead.drawing
    assert isinstance(again.drawing, PenDrawing)
    assert again.digest == ahead.digest


def test_a_background_of_a_world_file_that_is_no_color():
    data = World.load("turtlesim").to_data() | {"pond": {"background": [0, 0, 256]}}
    with pytest.raises(ValueError) as caught:
        World.from_data(data)
    assert str(caught.value) == (
        "the world: pond.background is [0, 0, 256]; "
        "write [red, green, blue], each a whole number from 0 to 255."
    )
