"""What a shift asks: each kind of question is earned by a small run, in a hall without shelves."""

import functools

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.checks.questions import questions
from sim import Recording, World, run
from sim.world import BatteryModel, Person, WarehouseModel

DESK = (1.5, 0.0, 0.0)
STAYS, FORWARD, BACK = (8, 0, 0), (3, 0.5, 0), (3, -0.5, 0)  # s, m/s, rad/s
CIRCLES = (30, 0.4, 0.4)
WALL = Person(((1.5, 0.0), (1.6, 0.0)), speed=0.1)
BESIDE = Person(((1.0, 1.0), (1.0, 1.2)), speed=0.1)
AWAY = Person(((-3.0, 3.0), (-3.0, 3.2)), speed=0.1)


class Driver(Node):
    """Drives as it was told, whatever comes: one part after the other. Then it stands."""

    def __init__(self, *parts: tuple[float, float, float]) -> None:
        super().__init__("driver")
        self.commands = [part[1:] for part in parts for _ in range(round(part[0] * 10))]
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        command = Twist()
        if self.commands:
            command.linear.x, command.angular.z = map(float, self.commands.pop(0))
        self.publisher.publish(command)


def work(parts, seconds=14, pickup=(0.0, 0.0, 0.0), orders=None, **more) -> Recording:
    """A shift that begins at (0, 0), with an order at 2 s. The desk is at (1.5, 0)."""
    warehouse = WarehouseModel(
        (pickup,), DESK, **{"interval": 1000, "patience": 100, "canceled": 0} | (orders or {})
    )
    hall = World("hall", "", (-4, -4, 4, 4), (0, 0, 0), warehouse=warehouse, **more)
    return run(functools.partial(Driver, *parts), world=hall, seconds=seconds, seed=1, quiet=True)


def asked(recording: Recording) -> list[str]:
    return [question.text for question in questions(recording)]


@pytest.mark.parametrize(
    ("shift", "texts"),
    [
        pytest.param(
            {"parts": (STAYS, FORWARD)},
            [
                "Order 1 came at 2.0 s and took 10.4 s: how much of that was driving?",
                "From 3.0 to 8.1 s it stood with order 1 aboard, 0.0 m from shelf_1: for what?",
            ],
            id="stands with a load",
        ),
        pytest.param(
            {"parts": (STAYS, FORWARD), "pickup": DESK},
            [
                "From 2.0 to 8.1 s it stood while order 1 waited, 1.5 m from the desk: for what?",
                "Order 1 came at 2.0 s and took 11.5 s: how much of that was driving?",
            ],
            id="answers late",
        ),
        pytest.param(
            {"parts": ((20, 0.5, 0),), "people": (WALL,), "seconds": 6},
            [
                "At 2.8 s it touched somebody: which program should have let it stand before, "
                "and what did that one know?",
                "From 2.8 to 6.0 s it stood while order 1 waited, 0.2 m from the desk: for what?",
            ],
            id="touches somebody",
        ),
        pytest.param(
            {"parts": ((3, 0, 0), (20, 0.5, 0)), "people": (AWAY, BESIDE), "seconds": 8},
            [
                "From 2.0 to 3.0 s it stood while order 1 waited, 0.0 m from shelf_1: for what?",
                "At 4.8 s it drove at 0.50 m/s, 0.9 m from somebody: what did it know of this person?",
            ],
            id="comes near somebody",
        ),
        pytest.param(
            {"parts": (), "pickup": DESK, "orders": {"patience": 5}, "seconds": 9},
            [
                "From 2.0 to 7.0 s it stood while order 1 waited, 1.5 m from the desk: for what?",
                "Order 1 came at 2.0 s and expired at 7.0 s; it was never fetched: "
                "which rule left it, and was that right?",
            ],
            id="leaves an order",
        ),
        pytest.param(
            {"parts": (), "orders": {"patience": 5}, "seconds": 9},
            [
                "Order 1 came at 2.0 s and expired at 7.0 s; it was aboard from 3.0 s on: "
                "where did the time go?",
                "From 3.0 to 7.0 s it stood with order 1 aboard, 0.0 m from shelf_1: for what?",
            ],
            id="is too late",
        ),
        pytest.param(
            {"parts": (), "orders": {"withdrawn": (5.0,)}, "seconds": 9},
            [
                "From 3.0 to 5.0 s it stood with order 1 aboard, 0.0 m from shelf_1: for what?",
                "At 5.0 s order 1 was canceled, and it was aboard: what did the robot do then, "
                "and was that right?",
            ],
            id="has a canceled order aboard",
        ),
        pytest.param(
            {"parts": (STAYS, FORWARD), "pickup": DESK, "battery": BatteryModel((0, 0), start=0.2)},
            [
                "From 0.0 to 9.0 s it charged, from 20% to 34%, while an order waited: why then, "
                "and why so long?",
                "Order 1 came at 2.0 s and took 11.5 s: how much of that was driving?",
            ],
            id="charges while an order waits",
        ),
        pytest.param(
            {"parts": (CIRCLES,), "battery": BatteryModel((-1, 0), capacity=0.001)},
            [
                "From 8.9 to 14.0 s it stood while order 1 waited, 2.0 m from shelf_1: for what?",
                "At 9.0 s the battery was empty, 2.0 m from shelf_1: "
                "when should the robot have turned round?",
            ],
            id="has an empty battery",
        ),
        pytest.param(
            {"parts": ((4, 0, 0), FORWARD, FORWARD, BACK), "seconds": 17},
            [
                "Order 1 came at 2.0 s and took 12.4 s: how much of that was driving?",
                "From 3.0 to 14.4 s it drove 4.4 m with order 1 aboard; in a straight line it is 1.6 m: "
                "what was in between, and was there a shorter way?",
            ],
            id="goes a long way round",
        ),
        pytest.param(
            {"parts": (CIRCLES,)},
            [
                "It drove 6 m and delivered nothing: where did it want to go?",
                "Order 1 came at 2.0 s and still waited at 14.0 s: what kept the robot from it?",
            ],
            id="drives in vain",
        ),
        pytest.param(
            {"parts": (CIRCLES,), "seconds": 4},
            ["Order 1 came at 2.0 s and still waited at 4.0 s: what kept the robot from it?"],
            id="has hardly begun",
        ),
        pytest.param({"parts": (CIRCLES,), "seconds": 1}, [], id="has no order yet"),
    ],
)
def test_what_is_asked_of_a_robot_that(shift, texts):
    assert asked(work(**shift)) == texts


def test_of_several_orders_the_one_that_took_longest():
    parts = (3.5, 0, 0), FORWARD, (1.5, 0, 0), BACK, (1.5, 0, 0), FORWARD
    assert asked(work(parts, orders={"interval": 4}, seconds=18))[0] == (
        "Order 2 came at 7.9 s and took 9.0 s, longer than any other: how much of that was driving?"
    )


@pytest.fixture(scope="module")
def eventful() -> Recording:
    """A shift in which there is more to ask than five questions."""
    parts = STAYS, FORWARD, FORWARD, BACK, STAYS, BACK
    orders, battery = {"interval": 4, "patience": 20}, BatteryModel((0, 0), start=0.2)
    return work(parts, orders=orders, battery=battery, people=(BESIDE,), seconds=31)


def test_at_most_five_in_the_order_of_time(eventful):
    assert asked(eventful) == [
        "From 3.0 to 8.1 s it stood with order 1 aboard, 0.0 m from the charger: for what?",
        "Order 2 came at 7.9 s and expired at 27.9 s; it was never fetched: which rule left it, "
        "and was that right?",
        "From 17.4 to 25.1 s it stood while order 3 waited, 0.1 m from the desk: for what?",
        "At 26.9 s it drove at 0.50 m/s, 0.9 m from somebody: what did it know of this person?",
        "From 28.0 to 31.0 s it charged, from 31% to 35%, while 6 orders waited: why then, and why so long?",
    ]


def test_each_has_the_time_that_it_is_about(eventful):
    for begin, end, text in questions(eventful):
        assert 0 <= begin <= end <= eventful.stamp
        assert f"{begin:.1f}" in text
        assert eventful.during(0, end).replay().html


def test_equal_runs_ask_the_same():
    first, second = (questions(work((STAYS, FORWARD))) for _ in range(2))
    assert first == second
