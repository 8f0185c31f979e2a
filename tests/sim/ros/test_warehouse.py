"""A warehouse in a run: its orders, its map, its charger, and a robot that comes for them."""

import dataclasses
import itertools

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from warehouse_msgs.msg import Order

from sim import Process, Recording, World, run, since_start
from sim.world import BatteryModel, Box, OtherRobot, WarehouseModel

KEPT = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WAITING, PICKED_UP, DELIVERED, EXPIRED, CANCELED = range(5)
FLOOR = World(
    *("floor", "", (-1, -1, 3, 1), (0, 0, 0)),
    battery=BatteryModel((0.0, 0.0), start=0.5),
    warehouse=WarehouseModel(((1.5, 0, 0),), (0, 0, 0), interval=12, patience=40, canceled=0),
)


class Shuttle(Node):
    """Drives to x = 1.5 m and back to 0, and stays so long at each end (s)."""

    stay = 1.5

    def __init__(self):
        super().__init__("shuttle")
        self.goal, self.there = 1.5, 0
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)

    def on_odom(self, odom):
        left = self.goal - odom.pose.pose.position.x
        if abs(left) < 0.01:
            self.there += 1
            if self.there > 20 * self.stay:
                self.goal, self.there = 1.5 - self.goal, 0
        command = Twist()
        command.linear.x = max(min(4 * left, 0.5), -0.5)
        self.publisher.publish(command)


class Hasty(Shuttle):
    stay = 0.2


class Late(Node):
    """Listens to the orders from 15 s on."""

    def __init__(self):
        super().__init__("late")
        self.timer = self.create_timer(15.0, self.listen)

    def listen(self):
        self.timer.cancel()
        self.create_subscription(Order, "/orders", self.tell, KEPT)

    def tell(self, order):
        self.get_logger().info(f"{order.id} {order.status}")


def statuses(recording):
    """(id, status) of all that was published."""
    return [(item.message.id, item.message.status) for item in recording.messages("/orders")]


@pytest.fixture(scope="module")
def served():
    return run(Shuttle, Late, world=FLOOR, seconds=60, quiet=True)


def test_orders_come_are_picked_up_and_delivered(served):
    of_first = [item for item in served.messages("/orders") if item.message.id == 1]
    assert [item.message.status for item in of_first] == [WAITING, PICKED_UP, DELIVERED]
    first, taken, brought = of_first
    assert first.stamp == 2.0
    assert served.pose_at(taken.stamp).x == pytest.approx(1.5, abs=0.02)
    assert served.pose_at(brought.stamp).x == pytest.approx(0, abs=0.02)
    order = taken.message
    assert since_start(order.header.stamp) == taken.stamp
    assert since_start(order.deadline) == pytest.approx(42.0)
    assert (order.header.frame_id, order.pickup.header.frame_id) == ("map", "map")
    assert (order.pickup.pose.position.x, order.delivery.pose.position.x) == (1.5, 0.0)


def test_one_load_at_a_time_and_the_oldest_first(served):
    carried = 0
    for number, status in statuses(served):
        carried += {PICKED_UP: 1, DELIVERED: -1}.get(status, 0)
        assert carried in (0, 1), number
    taken = [number for number, status in statuses(served) if status == PICKED_UP]
    assert len(taken) > 3 and taken == sorted(taken)


def test_a_late_subscriber_receives_all_orders(served):
    texts = [line.text for line in served.logs if line.node == "late"]
    before = [f"{item.message.id} {item.message.status}" for item in served.messages("/orders")]
    assert texts == before
    assert served.errors == []


def test_the_map_its_frame_and_the_charger_are_reported_once(served):
    (grid,) = [item.message for item in served.messages("/map")]
    assert (grid.header.frame_id, grid.info.width, grid.info.height) == ("map", 84, 44)
    assert set(grid.data) == {0}
    (dock,) = [item.message for item in served.messages("/dock_pose")]
    assert (dock.header.frame_id, dock.pose.position.x, dock.pose.position.y) == ("map", 0.0, 0.0)
    frames = [
        (transform.header.frame_id, transform.child_frame_id)
        for item in served.messages("/tf_static")
        for transform in item.message.transforms
    ]
    assert frames == [("base_link", "base_scan"), ("map", "odom")]


def test_a_map_shows_what_stands_still_where_it_is():
    world = World.generate("warehouse", seed=3)
    (item,) = run(world=world, seconds=0.1).messages("/map")
    grid = item.message
    cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)

    def at(x, y):
        origin, size = grid.info.origin.position, grid.info.resolution
        return cells[int((y - origin.y) / size), int((x - origin.x) / size)]

    assert all(at(box.x, box.y) == 100 for box in world.boxes)
    assert at(0.0, 1.0) == at(world.bounds[2], 1.0) == 100
    assert all(at(box.x, box.y) == 0 for box in world.movable)
    assert all(at(x, y) == 0 for x, y, *_ in world.places().values())


def test_a_battery_tells_its_state_and_is_filled_at_the_charger(served):
    states = served.messages("/battery_state")
    assert [item.stamp for item in states[:3]] == [0.0, 1.0, 2.0]
    shares = [item.message.percentage for item in states]
    assert shares[0] == 0.5 and max(shares) > 0.6
    statuses = {item.message.power_supply_status for item in states}
    assert statuses == {1, 2}  # charging, discharging
    full = run(world=FLOOR, seconds=40).messages("/battery_state")[-1].message
    assert (full.percentage, full.power_supply_status) == (1.0, 4)


def test_who_does_not_stay_gets_nothing():
    hurried = run(Hasty, world=FLOOR, seconds=20, quiet=True)
    assert {status for _, status in statuses(hurried)} == {WAITING}


@pytest.mark.parametrize(("share", "ending"), [(0.0, EXPIRED), (1.0, CANCELED)])
def test_an_order_that_no_one_brings_ends(share, ending):
    model = dataclasses.replace(FLOOR.warehouse, patience=10, canceled=share)
    recording = run(world=dataclasses.replace(FLOOR, warehouse=model), seconds=20)
    (end,) = [item for item in recording.messages("/orders") if statuses_of(item) == (1, ending)]
    assert end.stamp == 12.0 if ending == EXPIRED else 2.0 < end.stamp < 12.0


def statuses_of(item):
    return item.message.id, item.message.status


def test_a_load_that_expires_makes_room_for_the_next():
    model = dataclasses.replace(FLOOR.warehouse, patience=9.5, interval=6)

    class Slow(Shuttle):
        stay = 7

    recording = run(Slow, world=dataclasses.replace(FLOOR, warehouse=model), seconds=60, quiet=True)
    ends = dict(statuses(recording))
    assert EXPIRED in ends.values()
    taken = [number for number, status in statuses(recording) if status == PICKED_UP]
    assert len(taken) > 1 and len(set(taken)) == len(taken)


def test_which_orders_come_is_decided_by_world_and_seed(served):
    def orders(world, seed):
        return [
            (item.stamp, item.message.id)
            for item in run(world=world, seconds=30, seed=seed).messages("/orders")
        ]

    assert orders(FLOOR, 1) == orders(FLOOR, 1) != orders(FLOOR, 2)
    assert orders(FLOOR, 1) != orders(dataclasses.replace(FLOOR, name="another"), 1)


def test_an_order_that_is_carried_can_be_withdrawn_and_else_the_oldest_one():
    floor = dataclasses.replace(FLOOR.warehouse, withdrawn=(30, 9))
    world = dataclasses.replace(FLOOR, warehouse=floor)
    recording = run(Shuttle, world=world, seconds=31)
    canceled = [item for item in recording.messages("/orders") if item.message.status == CANCELED]
    assert [item.stamp for item in canceled] == [9.0, 30.0]
    carried = [
        item.message.id
        for item in recording.during(0.0, 9.0).messages("/orders")
        if item.message.status == PICKED_UP
    ]
    assert canceled[0].message.id == carried[-1]
    left = run(world=world, seconds=31).messages("/orders")
    assert [item.message.id for item in left if item.message.status == CANCELED] == [1, 2]


def test_a_lidar_can_be_silent_for_a_while():
    lidar = dataclasses.replace(FLOOR.lidar, silent=((1, 2.5), (4, 5)))
    recording = run(world=dataclasses.replace(FLOOR, lidar=lidar), seconds=6)
    stamps = [item.stamp for item in recording.messages("/scan")]
    pauses = [(a, b) for a, b in itertools.pairwise(stamps) if b - a > 0.1]
    assert pauses == [(0.95, 2.5), (3.95, 5.0)]
    assert len(recording.messages("/odom")) == 121


def test_a_scan_is_published_a_lidar_s_latency_after_its_stamp():
    lidar = dataclasses.replace(FLOOR.lidar, latency=0.12)
    recording, prompt = (
        run(world=dataclasses.replace(FLOOR, lidar=each), seconds=1) for each in (lidar, FLOOR.lidar)
    )
    late = [(item.stamp, since_start(item.message.header.stamp)) for item in recording.messages("/scan")]
    assert late[:2] == [(0.15, 0.0), (0.2, 0.05)] and len(late) == 18
    both = zip(recording.messages("/scan"), prompt.messages("/scan"), strict=False)
    assert all(one.message == other.message for one, other in both)


class Stands(Node):
    """Takes what comes where it stands."""

    def __init__(self):
        super().__init__("stands")


def test_two_robots_share_the_orders_and_each_says_whose_it_is():
    other = OtherRobot("two", (0.0, 0.0, 0.0), charger=(1.5, 0.5))
    floor = dataclasses.replace(FLOOR, start=(0, 0.6, 0), robots=(other,))
    recording = run(Stands, Process(Shuttle, namespace="two"), world=floor, seconds=40, quiet=True)
    who = {(item.message.status, item.message.robot) for item in recording.messages("/orders")}
    assert who == {(WAITING, ""), (PICKED_UP, "two"), (DELIVERED, "two")}
    docks = [recording.messages(name)[0].message for name in ("/dock_pose", "/two/dock_pose")]
    assert [(dock.pose.position.x, dock.pose.position.y) for dock in docks] == [(0.0, 0.0), (1.5, 0.5)]
    frames = [
        (transform.header.frame_id, transform.child_frame_id)
        for item in recording.messages("/tf_static", sender="/map_server")
        for transform in item.message.transforms
    ]
    assert frames == [("map", "odom"), ("map", "two/odom")]


def test_what_other_robots_touch_is_kept(tmp_path):
    other = OtherRobot("two", (2.0, 0.0, 0.0))
    floor = dataclasses.replace(FLOOR, robots=(other,), boxes=(Box(2.5, 0, 0, 0.2, 1),), battery=None)
    recording = run(Process(Shuttle, namespace="two"), world=floor, seconds=4, quiet=True)
    (touch,) = recording.other_contacts["two"]
    assert (recording.contacts, touch.what) == ([], "box")
    assert recording.during(0, touch.stamp).other_contacts == {"two": []}
    recording.save(tmp_path / "two.mcap")
    assert Recording.load(tmp_path / "two.mcap").other_contacts == recording.other_contacts
