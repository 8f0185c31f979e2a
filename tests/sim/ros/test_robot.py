"""The robot as a ROS node: topics, types, frames, stamps, units, and the world behind them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from sim import Process, World, run
from sim.evidence import since_start
from sim.world import DT, RobotModel, WheelModel
from tests.sim.ros.evidence import logged, values
from tests.students.engine import drivers

MODEL = RobotModel()
FLOOD = (
    "More than 1000 velocity commands arrived in one second; 10 to 20 are enough: "
    "check the period of the timer that sends them."
)
TICKS = [tick / 20 for tick in range(41)]  # of the sensors in 2 s
SENSORS = {
    "/odom": "nav_msgs/msg/Odometry", "/scan": "sensor_msgs/msg/LaserScan", "/bumper": "std_msgs/msg/Bool",
    "/joint_states": "sensor_msgs/msg/JointState", "/tf": "tf2_msgs/msg/TFMessage",
}  # fmt: skip


@pytest.fixture(scope="module")
def straight():
    """0.5 m/s ahead, commanded from 0.1 s on, in the open."""
    return run(drivers.Driver, world="yard", seconds=2, quiet=True)


@pytest.fixture(scope="module")
def still():
    """No one drives, in a room with walls."""
    return run(drivers.Watcher, world="room", seconds=2, quiet=True)


def received(recording, topic):
    """(stamp, message) of every message."""
    return [(received.stamp, received.message) for received in recording.messages(topic)]


def yaw_of(orientation):
    assert (orientation.x, orientation.y) == (0.0, 0.0)
    return 2 * math.atan2(orientation.z, orientation.w)


def speed_after(steps, v=0.5):
    """The ramp: at most the greatest acceleration, in physics steps."""
    return min(MODEL.max_acceleration * DT * steps, v)


def test_topics_types_and_qos(straight):
    assert {topic: straight.topics[topic] for topic in SENSORS} == SENSORS
    (command,) = straight.graph.subscriptions("/cmd_vel")
    assert (command.node, command.type) == ("/robot", "geometry_msgs/msg/Twist")
    for topic in (*SENSORS, "/cmd_vel"):
        for end in straight.graph.publishers(topic) + straight.graph.subscriptions(topic):
            assert (end.qos["reliability"], end.qos["durability"]) == ("reliable", "volatile")


@pytest.mark.parametrize("topic", [*SENSORS, "/clock"])
def test_every_sensor_speaks_twenty_times_a_second(straight, topic):
    assert [h.stamp for h in straight.messages(topic)] == TICKS
    assert {h.sender for h in straight.messages(topic)} == {"/robot"}


def test_stamps_in_messages_are_the_times_they_were_sent(straight):
    headers = {"/odom": lambda m: m.header, "/scan": lambda m: m.header, "/joint_states": lambda m: m.header,
               "/tf": lambda m: m.transforms[0].header}  # fmt: skip
    for topic, header in headers.items():
        inside = [since_start(header(m).stamp) for _, m in received(straight, topic)]
        assert inside == TICKS
    assert [since_start(m.clock) for _, m in received(straight, "/clock")] == TICKS


def test_messages_reach_reliable_and_best_effort_listeners_at_once(still):
    assert logged(still)[:4] == [
        (0.05, "odom 1735689600050000000 0"), (0.05, "scan 1735689600050000000 0"),
        (0.1, "odom 1735689600100000000 0"), (0.1, "scan 1735689600100000000 0"),
    ]  # fmt: skip


def test_frames_are_those_of_rep_105(straight):
    (_, odom), (_, scan), (_, tf) = (received(straight, topic)[-1] for topic in ("/odom", "/scan", "/tf"))
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_link")
    assert scan.header.frame_id == "base_scan"
    (transform,) = tf.transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_link")


def test_where_the_lidar_sits_is_said_once_and_kept():
    world = World.load("yard")
    turned = replace(world, lidar=replace(world.lidar, x=0.06, y=-0.02, yaw=2.0))
    recording = run(world=turned, seconds=1, quiet=True)
    (end,) = recording.graph.publishers("/tf_static")
    assert (end.node, end.qos["durability"]) == ("/robot", "transient_local")
    ((stamp, message),) = received(recording, "/tf_static")
    (transform,) = message.transforms
    assert (stamp, transform.header.frame_id, transform.child_frame_id) == (0.0, "base_link", "base_scan")
    place = transform.transform.translation
    assert (place.x, place.y, yaw_of(transform.transform.rotation)) == pytest.approx((0.06, -0.02, 2.0))


def test_odometry_follows_the_ramp_and_its_sum(straight):
    """Speed rises 2 m/s^2 from the first command at 0.1 s; the way is the sum of the speeds before."""
    for stamp, odom in received(straight, "/odom"):
        steps = max(round((stamp - 0.1) / DT), 0)
        way = sum(speed_after(step) * DT for step in range(steps))
        assert odom.twist.twist.linear.x == pytest.approx(speed_after(steps), abs=1e-12)
        assert odom.pose.pose.position.x == pytest.approx(way, abs=1e-12)
        assert (odom.pose.pose.position.y, odom.twist.twist.linear.y) == (0.0, 0.0)


def test_odometry_and_transform_say_the_same(straight):
    for (_, odom), (_, tf) in zip(received(straight, "/odom"), received(straight, "/tf"), strict=True):
        pose, move = odom.pose.pose, tf.transforms[0].transform
        assert (pose.position.x, pose.position.y) == (move.translation.x, move.translation.y)
        assert pose.orientation == move.rotation


def test_turning_is_counter_clockwise_in_radians():
    recording = run(drivers.Turner, world="yard", seconds=2, quiet=True)
    (_, before), (_, after) = received(recording, "/odom")[20], received(recording, "/odom")[40]
    assert yaw_of(after.pose.pose.orientation) - yaw_of(before.pose.pose.orientation) == pytest.approx(1.0)
    assert after.twist.twist.angular.z == 1.0
    assert math.hypot(after.pose.pose.position.x, after.pose.pose.position.y) == 0.0


def test_a_circle_has_radius_v_by_w():
    recording = run(drivers.Circler, world="yard", seconds=6, quiet=True)
    centers = []
    for stamp, odom in received(recording, "/odom"):
        position, yaw = odom.pose.pose.position, yaw_of(odom.pose.pose.orientation)
        if stamp > 0.5:
            centers.append((position.x - 0.5 * math.sin(yaw), position.y + 0.5 * math.cos(yaw)))
    assert centers == [pytest.approx(centers[0], abs=1e-9)] * len(centers)


def test_wheels_roll_as_far_as_the_robot_drives(straight):
    joints, odom = received(straight, "/joint_states"), received(straight, "/odom")
    for (_, joint), (_, pose) in zip(joints, odom, strict=True):
        assert joint.name == ["wheel_left_joint", "wheel_right_joint"]
        way, speed = pose.pose.pose.position.x, pose.twist.twist.linear.x
        assert list(joint.position) == [pytest.approx(way / MODEL.wheel_radius)] * 2
        assert list(joint.velocity) == [pytest.approx(speed / MODEL.wheel_radius)] * 2


def test_where_its_world_says_so_the_robot_takes_stamped_commands(straight):
    yard = World.load("yard")
    stamped = replace(yard, robot=replace(yard.robot, stamped=True))
    recording = run(drivers.StampedDriver, world=stamped, seconds=2, quiet=True)
    (command,) = recording.graph.subscriptions("/cmd_vel")
    assert command.type == "geometry_msgs/msg/TwistStamped"
    assert recording.path == straight.path


def test_without_commands_the_robot_stops_after_half_a_second():
    recording = run(drivers.CommandsOnce, world="yard", seconds=2, quiet=True)
    assert [h.stamp for h in recording.messages("/cmd_vel")] == [0.1]
    speeds = {stamp: odom.twist.twist.linear.x for stamp, odom in received(recording, "/odom")}
    assert speeds[0.6] == 0.5
    assert speeds[0.65] == pytest.approx(0.4)
    assert all(speed == 0.0 for stamp, speed in speeds.items() if stamp >= 0.85)


@pytest.mark.parametrize("driver, command", [
    (drivers.CommandsNoNumber, "nan m/s and 0.0 rad/s"), (drivers.CommandsInfinity, "0.1 m/s and inf rad/s"),
])  # fmt: skip
def test_a_command_that_is_no_number_is_reported_once_a_second_and_ignored(driver, command):
    recording = run(driver, world="yard", seconds=2.5, quiet=True)
    words = f"Velocity commands are finite numbers; this one was {command}: check how it was calculated."
    assert logged(recording) == [(stamp, words) for stamp in (0.1, 1.1, 2.1)]
    assert {(line.level, line.node) for line in recording.logs} == {("ERROR", "robot")}
    assert recording.path[-1] == (2.5, 0.0, 0.0, 0.0)
    assert recording.errors == []


def test_a_flood_of_commands_is_reported_once_a_second_and_obeyed():
    recording = run(drivers.Flood, world="yard", seconds=2.5, quiet=True)
    assert tuple(recording.ended) == ("time", 2.5, "All 2.5 s were run.")
    assert len(recording.messages("/cmd_vel")) == 25_000
    assert logged(recording) == [(stamp, FLOOD) for stamp in (0.05, 1.05, 2.05)]
    assert {(line.level, line.node) for line in recording.logs} == {("WARN", "robot")}
    assert [stamp for stamp, _ in received(recording, "/scan")] == [tick / 20 for tick in range(51)]
    assert received(recording, "/odom")[-1][1].twist.twist.linear.x == 0.5


@pytest.mark.parametrize("first, second, end", [
    (drivers.Driver, drivers.Turner, (0.0, 1.0)), (drivers.Turner, drivers.Driver, (0.5, 0.0)),
])  # fmt: skip
def test_of_two_that_command_at_once_the_later_is_obeyed(first, second, end):
    recording = run(first, Process(second, name="other"), world="yard", seconds=2, quiet=True)
    assert {h.sender for h in recording.messages("/cmd_vel")} == {"/driver", "/other"}
    twist = received(recording, "/odom")[-1][1].twist.twist
    assert (twist.linear.x, twist.angular.z) == end
    assert recording.logs == []


def test_a_scan_begins_ahead_and_goes_round_to_the_left(still):
    (_, scan) = received(still, "/scan")[0]
    assert len(scan.ranges) == 360
    step = math.tau / 360
    assert (scan.angle_min, scan.angle_increment) == (0.0, pytest.approx(step))
    assert scan.angle_max == pytest.approx(scan.angle_min + 359 * step)
    assert (scan.range_min, scan.range_max, scan.scan_time) == (
        pytest.approx(0.12), pytest.approx(3.5), pytest.approx(0.05),
    )  # fmt: skip


def test_a_scan_shows_the_room(still):
    """From the middle of the room: walls 3 m ahead, left and behind, a box 1.5 m to the right."""
    for _, scan in received(still, "/scan"):
        assert [scan.ranges[angle] for angle in (0, 90, 180, 270)] == pytest.approx([3, 3, 3, 1.5], abs=0.06)
        assert scan.ranges[315] == math.inf  # the corner is 4.2 m away


def test_the_noise_of_a_scan_depends_on_the_seed_alone():
    raws = [
        [h.raw for h in run(world="room", seconds=1, seed=seed, quiet=True).messages("/scan")]
        for seed in (1, 1, 2)
    ]
    assert raws[0] == raws[1] != raws[2]
    assert len(set(raws[0])) == 21


def test_in_an_empty_yard_the_lidar_sees_nothing(straight):
    (_, scan) = received(straight, "/scan")[-1]
    assert set(scan.ranges) == {math.inf}


def test_a_wall_stops_the_robot_and_presses_the_bumper():
    """The wall is 3 m ahead and the robot's radius 0.1 m; its wheels go on and slip."""
    recording = run(drivers.Driver, world="room", seconds=8, quiet=True)
    pressed = [stamp for stamp, data in values(recording, "/bumper") if data]
    (contact,) = recording.contacts
    assert pressed[0] == pytest.approx(contact.stamp, abs=0.05) and pressed[0] >= contact.stamp
    assert (contact.side, contact.what, contact.end) == ("front", "wall", None)
    assert recording.path[-1].x == pytest.approx(2.9, abs=0.005)
    first, *_, last = (message for _, message in received(recording, "/odom"))
    assert last.pose.pose.position.x > 3.5
    assert (first.twist.covariance[0], first.pose.covariance[0]) == (0.0, 0.0)
    assert last.twist.covariance[0] == last.twist.twist.linear.x**2 > 0.0 == last.twist.covariance[35]
    assert last.pose.covariance[0] > 0.5


def test_the_path_is_the_truth_in_the_map_frame():
    """Where the robot starts is the odom frame's origin."""
    recording = run(drivers.Driver, world="maze", seconds=1, quiet=True)
    assert recording.path[0] == (0.0, 0.5, 0.5, pytest.approx(math.pi / 2))
    assert [pose.stamp for pose in recording.path] == TICKS[:21]
    ahead = received(recording, "/odom")[-1][1].pose.pose.position.x
    assert recording.path[-1].y - 0.5 == pytest.approx(ahead, abs=1e-3)
    assert recording.path[-1].x == pytest.approx(0.5, abs=1e-6)


def test_the_covariance_of_odometry_that_drifts_is_in_its_message():
    """Rows and columns are x, y, z and the turns about them: yaw is the sixth, so its variance is at 35."""
    wheels = WheelModel(slip=0.005, ticks=1000)
    world = replace(World.load("yard"), wheels=wheels)
    recording = run(drivers.Circler, world=world, seconds=4, quiet=True)
    odom = received(recording, "/odom")[-1][1]
    pose, twist = (np.array(part.covariance).reshape(6, 6) for part in (odom.pose, odom.twist))
    moving = np.ix_((0, 1, 5), (0, 1, 5))
    assert np.linalg.eigvalsh(pose[moving]).min() > 0 and (pose == pose.T).all()
    assert [odom.pose.covariance[index] for index in (0, 7, 35)] == list(np.diag(pose)[[0, 1, 5]])
    assert np.linalg.eigvalsh(twist[np.ix_((0, 5), (0, 5))]).min() > 0 and (twist == twist.T).all()
    pose[moving] = 0.0
    twist[np.ix_((0, 5), (0, 5))] = 0.0
    assert not pose.any() and not twist.any()
    off = recording.path[-1].x - odom.pose.pose.position.x
    assert 0 < abs(off) < 4 * math.sqrt(odom.pose.covariance[0])
