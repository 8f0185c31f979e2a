"""Further robots of a world: each in a namespace of its own, driven by commands or round a route."""

import array
import dataclasses
import itertools
import math

import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

from sim import Process, Recording, World, run
from sim.evidence import since_start
from sim.world import Box, ImuModel, LidarModel, MovableBox, OtherRobot, RobotModel, Route
from tests.students.engine import drivers

CORNERS = ((1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0))
LEADER = OtherRobot("leader", (1.0, 0.0, 0.0), CORNERS, 0.3)
STANDING = OtherRobot("carrier", (-1.0, -1.0, math.pi / 2))
SENSORS = ("odom", "scan", "joint_states", "bumper")


def yard(*robots, **more):
    return dataclasses.replace(World.load("yard"), robots=robots, **more)


def off_route(recording, robot):
    """How far it was from its route at most, m; corners are cut a little."""
    route = Route(robot.route)
    track = recording.tracks[robot.name]
    return max(math.dist(route.point(route.nearest(p.x, p.y)), (p.x, p.y)) for p in track)


@pytest.fixture(scope="module")
def three():
    """The first robot drives in circles, the leader round its route; the carrier stands."""
    return run(drivers.Circler, world=yard(LEADER, STANDING), seconds=30, quiet=True)


def test_each_robot_is_a_node_in_its_namespace(three):
    assert three.graph.nodes == ["/robot", "/leader/robot", "/carrier/robot", "/leader/driver", "/driver"]
    for name in ("leader", "carrier"):
        for sensor in SENSORS:
            stamps = [received.stamp for received in three.messages(f"/{name}/{sensor}", f"/{name}/robot")]
            assert stamps == [received.stamp for received in three.messages(f"/{sensor}", "/robot")]
        (command,) = three.graph.subscriptions(f"/{name}/cmd_vel")
        assert command.node == f"/{name}/robot"


def test_the_clock_is_the_first_robots_alone(three):
    assert {received.sender for received in three.messages("/clock")} == {"/robot"}
    assert len(three.messages("/clock")) == 601


def test_frames_begin_with_the_robots_name(three):
    scan = three.messages("/leader/scan")[-1].message
    odom = three.messages("/leader/odom")[-1].message
    assert scan.header.frame_id == "leader/base_scan"
    assert (odom.header.frame_id, odom.child_frame_id) == ("leader/odom", "leader/base_link")
    transforms = {
        (received.sender, transform.header.frame_id, transform.child_frame_id)
        for received in three.messages("/tf")
        for transform in received.message.transforms
    }
    assert transforms == {
        ("/robot", "odom", "base_link"),
        ("/leader/robot", "leader/odom", "leader/base_link"),
        ("/carrier/robot", "carrier/odom", "carrier/base_link"),
    }


def test_a_robot_is_driven_through_its_namespace():
    pusher = Process(drivers.Driver, namespace="/carrier")
    recording = run(pusher, world=yard(STANDING), seconds=3, quiet=True)
    assert recording.graph.publishers("/carrier/cmd_vel")[0].node == "/carrier/driver"
    end = recording.tracks["carrier"][-1]
    ahead = recording.messages("/carrier/odom")[-1].message.pose.pose.position.x
    assert ahead > 1
    assert (end.x, end.y) == pytest.approx((-1, -1 + ahead), abs=1e-3)
    assert recording.path[-1][1:] == (0, 0, 0)


def test_a_driver_stays_on_the_route_at_its_speed(three):
    assert off_route(three, LEADER) < 0.06
    track = three.tracks["leader"]
    way = sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in itertools.pairwise(track))
    assert 0.9 < way / (0.3 * 30) <= 1.0
    laps = [p for p in track if math.dist((p.x, p.y), (2, 0.5)) < 0.05]
    assert max(p.stamp for p in laps) - min(p.stamp for p in laps) > 12  # it came there again, a lap later


def test_a_driver_commands_as_its_robot_takes_it():
    convoy = World.load("convoy")
    stamped = dataclasses.replace(convoy, robot=dataclasses.replace(convoy.robot, stamped=True))
    usual, recording = (run(world=world, seconds=4, quiet=True) for world in (convoy, stamped))
    assert recording.topics["/leader/cmd_vel"] == "geometry_msgs/msg/TwistStamped"
    assert recording.tracks == usual.tracks
    received = recording.messages("/leader/cmd_vel")[-1]
    assert received.message.header.frame_id == "base_link"
    assert since_start(received.message.header.stamp) == received.stamp


def test_a_driver_speaks_as_often_as_it_receives_and_smoothly(three):
    commands = [received.message for received in three.messages("/leader/cmd_vel", "/leader/driver")]
    assert len(commands) == 600
    assert all(0 <= command.linear.x <= 0.3 for command in commands)
    turns = [command.angular.z for command in commands]
    most = RobotModel().max_angular_acceleration * 0.05  # what the robot can follow
    assert max(abs(b - a) for a, b in itertools.pairwise(turns)) < most


def test_a_driver_turns_round_at_the_ends_of_a_line():
    shuttle = OtherRobot("shuttle", (1.0, 1.0, math.pi), ((1.0, 1.0), (2.5, 1.0)), 0.4)
    recording = run(world=yard(shuttle), seconds=30, quiet=True)
    assert off_route(recording, shuttle) < 0.08
    xs = [pose.x for pose in recording.tracks["shuttle"]]
    assert min(xs) < 1.2 and max(xs) > 2.3
    there = [a < 1.75 <= b for a, b in itertools.pairwise(xs)]
    assert sum(there) >= 3  # times it passed the middle


def test_a_driver_finds_its_route_from_beside_it():
    stray = dataclasses.replace(LEADER, start=(1.5, -0.5, math.pi))
    recording = run(world=yard(stray), seconds=30, quiet=True)
    route = Route(CORNERS)
    late = [p for p in recording.tracks["leader"] if p.stamp > 5]
    assert max(math.dist(route.point(route.nearest(p.x, p.y)), (p.x, p.y)) for p in late) < 0.06


@pytest.mark.parametrize("thing", [
    {"robots": (LEADER, OtherRobot("carrier", (2.0, 0.0, 0.0)))}, {"boxes": (Box(2.0, 0.0, 0.3, 0.3, 0.3),)},
    {"boxes": (Box(2.0, 0.0, 0.3, 0.3, 0.3),), "lidar": LidarModel(x=-0.05, y=0.05, yaw=2.0)},
], ids=["robot", "box", "seen by a lidar that is turned"])  # fmt: skip
def test_a_driver_waits_while_something_stands_on_its_route(thing):
    recording = run(world=dataclasses.replace(yard(LEADER), **thing), seconds=15, quiet=True)
    track = recording.tracks["leader"]
    assert track[-1] == track[100]._replace(stamp=15.0)  # it has waited since 5 s or before
    assert 1.1 < track[-1].x < 1.6
    commands = [received.message.linear.x for received in recording.messages("/leader/cmd_vel")]
    assert len(commands) == 300 and commands[-1] == 0.0
    assert recording.contacts == []


def test_a_driver_goes_on_when_its_route_is_free_again():
    gone = Process(LeavesLater, namespace="/carrier")
    world = yard(LEADER, OtherRobot("carrier", (2.0, 0.0, -math.pi / 2)))
    recording = run(gone, world=world, seconds=15, quiet=True)
    track = recording.tracks["leader"]
    assert track[100].x < 1.6  # at 5 s it waits
    assert track[-1].y > 0.5  # later it drove on
    assert off_route(recording, LEADER) < 0.06


class LeavesLater(Node):
    """Drives off, 5 s after the start."""

    def __init__(self):
        super().__init__("leaver")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.tick)
        self.start = self.get_clock().now() + Duration(seconds=5)

    def tick(self):
        command = Twist()
        command.linear.x = 0.5 if self.get_clock().now() > self.start else 0.0
        self.publisher.publish(command)


class Impostor(Node):
    """Says impossible things in the leader's name."""

    def __init__(self):
        super().__init__("impostor")
        self.odom = self.create_publisher(Odometry, "leader/odom", 10)
        self.scan = self.create_publisher(LaserScan, "leader/scan", 10)
        numbers = math.nan, math.inf, -math.inf, 1e308
        fields = "position.x", "position.y", "orientation.z"
        self.lies = itertools.cycle(itertools.product(numbers, fields))
        self.create_timer(0.1, self.tick)

    def tick(self):
        odom, (number, field) = Odometry(), next(self.lies)
        part, axis = field.split(".")
        setattr(getattr(odom.pose.pose, part), axis, number)
        self.odom.publish(odom)  # one at a time: more would push the true ones out of the queue
        near = array.array("f", [0.3])
        self.scan.publish(LaserScan(angle_min=math.inf, ranges=near))
        self.scan.publish(LaserScan(angle_increment=math.nan, ranges=near))
        self.scan.publish(LaserScan(range_min=math.inf, ranges=near))


def test_a_driver_takes_no_notice_of_impossible_messages():
    recording = run(Impostor, world=yard(LEADER), seconds=15, quiet=True)
    assert recording.errors == [] and recording.logs == []
    assert off_route(recording, LEADER) < 0.06
    assert max(pose.y for pose in recording.tracks["leader"]) > 0.9
    assert len(recording.messages("/leader/cmd_vel")) == 300


class Follower(Node):
    """Keeps 0.6 m behind where the leader says it is; knows that it started 1 m ahead."""

    def __init__(self):
        super().__init__("follower")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "leader/odom", self.on_leader, 10)
        self.create_subscription(Odometry, "odom", self.on_own, 10)
        self.leader = None

    def on_leader(self, odom):
        self.leader = odom.pose.pose.position

    def on_own(self, odom):
        if self.leader is None:
            return
        own, turn = odom.pose.pose.position, odom.pose.pose.orientation
        dx, dy = self.leader.x + 1 - own.x, self.leader.y - own.y
        off = math.remainder(math.atan2(dy, dx) - 2 * math.atan2(turn.z, turn.w), math.tau)
        command = Twist()
        command.linear.x, command.angular.z = 1.5 * (math.hypot(dx, dy) - 0.6), 2.0 * off
        self.publisher.publish(command)


def test_a_leader_can_be_followed():
    recording = run(Follower, world=yard(LEADER), seconds=20, quiet=True)
    assert recording.errors == [] and recording.contacts == []
    pairs = zip(recording.path, recording.tracks["leader"], strict=True)
    gaps = [math.dist((a.x, a.y), (b.x, b.y)) for a, b in pairs if a.stamp > 5]
    assert min(gaps) > 0.3 and max(gaps) < 1.0


def test_other_robots_and_boxes_are_tracked_and_saved(tmp_path):
    box = MovableBox(1.0, 0.0, 0.0, 0.3, 0.3)
    world = yard(STANDING, movable=(box,))
    recording = run(drivers.Driver, world=world, seconds=4, quiet=True)
    assert list(recording.tracks) == ["carrier", "box_1"]
    assert {len(track) for track in recording.tracks.values()} == {81}
    assert recording.tracks["carrier"][-1] == (4.0, *STANDING.start)
    assert recording.tracks["box_1"][0] == (0.0, 1.0, 0.0, 0.0)
    assert recording.tracks["box_1"][-1].x > 1.2  # it was pushed
    assert recording.tracks["box_1"][-1].x - recording.path[-1].x == pytest.approx(0.25, abs=0.01)
    loaded = Recording.load(recording.save(tmp_path / "run.mcap"))
    assert (loaded.tracks, loaded.world, loaded.digest) == (recording.tracks, world, recording.digest)


def test_one_more_robot_changes_nothing_for_the_first():
    """But for what it sees: here it is too far away."""
    far = OtherRobot("far", (-3.0, -3.0, 0.0))
    alone, two = (
        run(drivers.Circler, world=yard(*robots, imu=ImuModel()), seconds=5, quiet=True)
        for robots in ((), (far,))
    )
    assert alone.path == two.path
    for topic in ("/odom", "/scan", "/imu/data", "/joint_states"):
        assert [h.raw for h in alone.messages(topic)] == [h.raw for h in two.messages(topic)]
