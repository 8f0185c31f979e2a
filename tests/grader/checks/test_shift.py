"""What a run in a warehouse shows of the robot's work."""

import json

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node
from warehouse_msgs.msg import Order

from grader.checks.motion import length
from grader.checks.shift import Job, ShiftProgram, shift
from sim import Process, Recording, World, run
from sim.evidence import Endpoint
from sim.world import Box, Circle, Contact, MovableBox, OtherRobot, Person, WarehouseModel
from tests.bench.capstone import work
from tests.sim.warehouse import order
from tests.sim.warehouse import worked as recorded

HALL = World(
    *("hall", "", (-2, -2, 4, 2), (0, 0, 0)),
    boxes=(Box(2.05, 0, 0, 0.1, 1),),
    warehouse=WarehouseModel(((1, 1, 0),), (0, 1, 0), interval=10, patience=5, canceled=0),
)


class Rammer(Node):
    """Drives straight on, and says that it delivered."""

    def __init__(self):
        super().__init__("rammer")
        self.velocity = self.create_publisher(Twist, "cmd_vel", 10)
        self.orders = self.create_publisher(Order, "/orders", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        command = Twist()
        command.linear.x = 0.5
        self.velocity.publish(command)
        self.orders.publish(Order(id=1, status=Order.DELIVERED))


@pytest.fixture(scope="module")
def worked() -> Recording:
    """The reference solution at work."""
    return work(7, 40.0)


def test_orders_with_their_times(worked):
    done = shift(worked)
    first = done.jobs[0]
    assert (first.id, first.requested, first.deadline, first.status) == (1, 2.0, 152.0, "delivered")
    assert first.requested < first.picked_up < first.over < first.deadline
    assert done.delivered[0] == first
    assert [job.id for job in done.jobs] == list(range(1, len(done.jobs) + 1))


def test_no_one_is_touched_and_the_battery_is_reported_each_second(worked):
    done = shift(worked)
    assert (done.touched, done.met_person) == ({}, None)
    assert [stamp for stamp, _ in done.battery] == [float(second) for second in range(41)]
    assert all(0 < share <= 1 for _, share in done.battery)
    assert 5 < done.way < 0.5 * 40


def test_which_program_did_what(worked):
    programs = shift(worked).programs
    assert sorted(programs) == ["/control", "/decision", "/perception"]
    control = programs["/control"]
    assert list(control.sent) == ["/cmd_vel"] and control.errors == 0
    assert control.subscribes == ("/goal_pose", "/map", "/obstacles", "/people", "/robot_pose")
    assert set(programs["/decision"].sent) == {"/goal_pose", "/state"}
    assert set(programs["/perception"].sent) == {"/obstacles", "/people", "/robot_pose"}


def test_all_of_it_is_plain_data(worked):
    data = shift(worked).to_data()
    assert json.loads(json.dumps(data))["jobs"][0]["status"] == "delivered"


def test_equal_runs_tell_the_same(worked):
    assert work(7, 40.0).digest == worked.digest


def test_what_a_program_says_of_orders_does_not_count():
    done = shift(run(Rammer, world=HALL, seconds=8, quiet=True))
    assert done.jobs[0] == Job(1, 2.0, 7.0, None, 7.0, "expired")
    assert done.touched == {"shelf": 1}
    assert done.programs == {"/rammer": ShiftProgram({"/cmd_vel": 80, "/orders": 80}, (), 0)}
    assert done.battery == ()


@pytest.mark.parametrize(
    ("thing", "name"),
    [
        ({"movable": (MovableBox(1.0, 0, 0, 0.3, 0.3),)}, "box"),
        ({"people": (Person(((1.5, 0.0), (-1.5, 0.0))),)}, "person"),
    ],
)
def test_what_was_touched_has_its_name(thing, name):
    world = World(*("hall", "", (-2, -2, 4, 2), (0, 0, 0)), warehouse=HALL.warehouse, **thing)
    done = shift(run(Rammer, world=world, seconds=2, quiet=True))
    assert set(done.touched) == {name}
    assert (done.met_person is not None) == (name == "person")


@pytest.mark.parametrize("world", [None, "yard"])
def test_a_run_without_a_warehouse_has_no_shift(world):
    with pytest.raises(ValueError) as caught:
        shift(run(world=world, seconds=0.1))
    assert str(caught.value) == (
        'this run has no warehouse: give run() a world such as World.generate("warehouse")'
    )


def test_robots_that_work_together_count_together():
    world = World(
        *("hall", "", (-2, -2, 4, 2), (0, 1, 0)),
        boxes=HALL.boxes,
        people=(Person(((1.5, 0.0), (-1.5, 0.0))),),
        robots=(
            OtherRobot("two", (0, -0.3, 0)),
            OtherRobot("drives", (-1, -1.5, 0), ((-1, -1.5), (0, -1.5))),
        ),
        warehouse=HALL.warehouse,
    )
    programs = [Process(Rammer, namespace=robot) for robot in (None, "two")]
    recording = run(*programs, world=world, seconds=6, quiet=True)
    done = shift(recording)
    (met,) = [touch.stamp for touch in recording.other_contacts["two"] if touch.what == "person"]
    assert (recording.contacts, done.met_person) == ([], met)
    apart = [length(path) for path in (recording.path, recording.tracks["two"])]
    assert done.way == sum(apart) and min(apart) > 0.2


def test_an_order_is_wanted_at_its_deadline_to_the_nanosecond():
    done = shift(recorded(order(1, waiting=2.9, patience=4.200000001), order(2, waiting=3.1, patience=4.8)))
    assert [job.deadline for job in done.jobs] == [7.100000001, 7.9]


def test_who_picked_an_order_up_is_known():
    done = shift(recorded(order(1, waiting=2.0, picked_up=3.0, delivered=9.0, robot="two")))
    assert done.jobs == (Job(1, 2.0, 102.0, 3.0, 9.0, "delivered", "two"),)


def touch(stamp, what, x=0.0, y=0.0):
    return Contact(stamp, stamp + 1.0, x, y, "front", what)


def test_the_first_person_that_any_robot_met_counts_and_touches_are_in_the_order_of_the_alphabet():
    world = World(
        *("hall", "", (-9, -9, 9, 9), (0, 0, 0)), robots=(OtherRobot("two", (5, 5, 0)),), warehouse=HALL.warehouse
    )
    own = [touch(1.0, "wall"), touch(4.0, "circle"), touch(5.0, "person"), touch(6.0, "person")]
    done = shift(recorded(world=world, contacts=own, other_contacts={"two": [touch(3.0, "person")]}))
    assert done.met_person == 3.0
    assert list(done.touched.items()) == [("circle", 1), ("person", 3), ("wall", 1)]


@pytest.mark.parametrize(
    ("x", "y", "name"),
    [(1.0, 0.0, "shelf"), (0.9955, 0.0, "shelf"), (0.9945, 0.0, "box"), (-3.0, 0.0, "box"), (0.0, 2.5, "box")],
)
def test_a_box_that_was_touched_is_a_shelf_where_one_stands_within_half_a_centimeter(x, y, name):
    world = World(
        *("hall", "", (-9, -9, 9, 9), (0, 0, 0)),
        boxes=(Box(2.0, 0, 0, 2.0, 1.0),),
        walls=(((-3.0, -1.0), (-3.0, 1.0)),),
        circles=(Circle(0.0, 3.0, 0.5),),
        warehouse=HALL.warehouse,
    )
    assert shift(recorded(world=world, contacts=[touch(1.0, "box", x, y)])).touched == {name: 1}


def test_what_a_program_receives_and_sends_is_in_the_order_of_the_alphabet_without_what_every_node_has():
    run_ = recorded(order(1, waiting=2.0))
    ends = [
        Endpoint(kind, "/control", topic, "std_msgs/msg/Empty", {})
        for kind, topic in [
            ("subscription", "/scan"),
            ("subscription", "/map"),
            ("subscription", "/map"),
            ("subscription", "/clock"),
            ("publisher", "/cmd_vel"),
        ]
    ]
    run_.graph.nodes, run_.graph.endpoints = ["/control"], ends
    sent = run_.published[0]._replace(sender="/control", from_course=False)
    run_.published += [sent._replace(topic=topic) for topic in ("/state", "/cmd_vel", "/cmd_vel")]
    program = shift(run_).programs["/control"]
    assert program == ShiftProgram({"/cmd_vel": 2, "/state": 1}, ("/map", "/scan"), 0)
    assert list(program.sent) == ["/cmd_vel", "/state"]
