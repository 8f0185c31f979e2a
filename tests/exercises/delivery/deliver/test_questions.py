"""What a shift asks: each kind of question is earned by a small run, in a hall without shelves."""

import functools
from dataclasses import replace

import pytest
from geometry_msgs.msg import Twist
from rclpy.node import Node

from grader.exercises.delivery.deliver.questions import questions
from sim import Recording, World, run
from sim.world import BatteryModel, Person, WarehouseModel
from tests.sim.warehouse import HALL, drive, order, worked

DESK = (1.5, 0.0, 0.0)
STAYS, FORWARD, BACK = (8, 0, 0), (3, 0.5, 0), (3, -0.5, 0)  # s, m/s, rad/s
CIRCLES = (30, 0.4, 0.4)
WALL = Person(((1.5, 0.0), (1.6, 0.0)), speed=0.1)
BESIDE = Person(((1.0, 1.0), (1.0, 1.2)), speed=0.1)
AWAY = Person(((-3.0, 3.0), (-3.0, 3.2)), speed=0.1)


class Driver(Node):
    """Drives as commanded, whatever comes: one part after the other. Then it stands."""

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
    warehouse = WarehouseModel((pickup,), DESK, **{"interval": 1000, "patience": 100, "canceled": 0} | (orders or {}))
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
                "From 3.0 to 8.1 s it stood with order 1 aboard, 0.0 m from shelf_1: what was it waiting for?",
            ],
            id="stands with a load",
        ),
        pytest.param(
            {"parts": (STAYS, FORWARD), "pickup": DESK},
            [
                "From 2.0 to 8.1 s it stood while order 1 waited, 1.5 m from the desk: what was it waiting for?",
                "Order 1 came at 2.0 s and took 11.5 s: how much of that was driving?",
            ],
            id="answers late",
        ),
        pytest.param(
            {"parts": ((20, 0.5, 0),), "people": (WALL,), "seconds": 6},
            [
                "At 2.8 s it touched a person: which program should have kept it standing still, and what did that program know?",
                "From 2.8 to 6.0 s it stood while order 1 waited, 0.2 m from the desk: what was it waiting for?",
            ],
            id="touches someone",
        ),
        pytest.param(
            {"parts": ((3, 0, 0), (20, 0.5, 0)), "people": (AWAY, BESIDE), "seconds": 8},
            [
                "From 2.0 to 3.0 s it stood while order 1 waited, 0.0 m from shelf_1: what was it waiting for?",
                "At 4.8 s it drove at 0.50 m/s, 0.9 m from a person: what did it know about this person?",
            ],
            id="comes near someone",
        ),
        pytest.param(
            {"parts": (), "pickup": DESK, "orders": {"patience": 5}, "seconds": 9},
            [
                "From 2.0 to 7.0 s it stood while order 1 waited, 1.5 m from the desk: what was it waiting for?",
                "Order 1 came at 2.0 s and expired at 7.0 s; it was never fetched: which rule skipped it, and was that right?",
            ],
            id="leaves an order",
        ),
        pytest.param(
            {"parts": (), "orders": {"patience": 5}, "seconds": 9},
            [
                "Order 1 came at 2.0 s and expired at 7.0 s; it was aboard from 3.0 s on: where did the time go?",
                "From 3.0 to 7.0 s it stood with order 1 aboard, 0.0 m from shelf_1: what was it waiting for?",
            ],
            id="is too late",
        ),
        pytest.param(
            {"parts": (), "orders": {"withdrawn": (5.0,)}, "seconds": 9},
            [
                "From 3.0 to 5.0 s it stood with order 1 aboard, 0.0 m from shelf_1: what was it waiting for?",
                "At 5.0 s order 1 was canceled, and it was aboard: what did the robot do then, and was that right?",
            ],
            id="has a canceled order aboard",
        ),
        pytest.param(
            {"parts": (STAYS, FORWARD), "pickup": DESK, "battery": BatteryModel((0, 0), start=0.2)},
            [
                "From 0.0 to 9.0 s it charged, from 20% to 34%, while an order waited: why then, and why so long?",
                "Order 1 came at 2.0 s and took 11.5 s: how much of that was driving?",
            ],
            id="charges while an order waits",
        ),
        pytest.param(
            {"parts": (CIRCLES,), "battery": BatteryModel((-1, 0), capacity=0.001)},
            [
                "From 8.9 to 14.0 s it stood while order 1 waited, 2.0 m from shelf_1: what was it waiting for?",
                "At 9.0 s the battery was empty, 2.0 m from shelf_1: when should the robot have turned back?",
            ],
            id="has an empty battery",
        ),
        pytest.param(
            {"parts": ((4, 0, 0), FORWARD, FORWARD, BACK), "seconds": 17},
            [
                "Order 1 came at 2.0 s and took 12.4 s: how much of that was driving?",
                "From 3.0 to 14.4 s it drove 4.4 m with order 1 aboard; the straight line is 1.6 m: "
                "what was in between, and was there a shorter way?",
            ],
            id="goes a long way round",
        ),
        pytest.param(
            {"parts": (CIRCLES,)},
            [
                "It drove 6 m and delivered nothing: where was it trying to go?",
                "Order 1 came at 2.0 s and still waited at 14.0 s: what kept the robot from fetching it?",
            ],
            id="drives in vain",
        ),
        pytest.param(
            {"parts": (CIRCLES,), "seconds": 4},
            ["Order 1 came at 2.0 s and still waited at 4.0 s: what kept the robot from fetching it?"],
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
        "From 3.0 to 8.1 s it stood with order 1 aboard, 0.0 m from the charger: what was it waiting for?",
        "Order 2 came at 7.9 s and expired at 27.9 s; it was never fetched: which rule skipped it, and was that right?",
        "From 17.4 to 25.1 s it stood while order 3 waited, 0.1 m from the desk: what was it waiting for?",
        "At 26.9 s it drove at 0.50 m/s, 0.9 m from a person: what did it know about this person?",
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


def texts(*orders, **more) -> list[str]:
    """What is asked about a run that was written by hand."""
    return [question.text.partition(":")[0] for question in questions(worked(*orders, **more))]


LEFT = order(1, waiting=2.0)
HERE = [(0.0, 0.0, 0.0), (40.0, 0.0, 0.0)]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(
    ("speed", "turn", "stands"), [(0.019, 0.048, True), (0.021, 0.0, False), (0.0, 0.052, False)]
)
def test_a_robot_stands_that_moves_and_turns_hardly_at_all(speed, turn, stands, side):
    path = drive((0.0, 0.0, 0.0, 0.0), (10.0, side * speed * 10, 0.0, side * turn * 10), (40.0, 30.0, 0.0))
    saw = "From 2.0 to 10.0 s it stood while order 1 waited, 0.0 m from shelf_1"
    assert (saw in texts(LEFT, path=path, seconds=40.0)) == stands


@pytest.mark.parametrize(("seconds", "asked"), [(2.4, False), (2.6, True)])
def test_a_pause_is_asked_about_that_is_longer_than_loading_takes(seconds, asked):
    path = drive((0.0, 0.0, 0.0), (2.0, 1.0, 0.0), (2.0 + seconds, 1.0, 0.0), (12.0, 6.0, 0.0))
    delivered = order(1, waiting=1.0, picked_up=1.5, delivered=12.0), order(3, waiting=1.0, expired=1.5)
    saw = f"From 2.0 to {2.0 + seconds:.1f} s it stood with order 1 aboard, 0.5 m from the desk"
    assert (saw in texts(*delivered, path=path)) == asked


@pytest.mark.parametrize(("speed", "away", "asked"), [(0.09, 1.0, 0), (0.11, 1.0, 1), (0.5, 1.9, 1), (0.5, 2.1, 0)])
def test_a_person_is_asked_about_whom_it_came_near_while_it_drove(speed, away, asked):
    world = replace(HALL, people=(BESIDE,))
    path = drive((0.0, 0.0, 0.0), (4.0, 4 * speed, 0.0))
    person = [pose._replace(y=away + BESIDE.radius) for pose in path]
    found = texts(world=world, path=path, tracks={"person_1": person})
    assert sum(f"it drove at {speed:.2f} m/s, {away:.1f} m from a person" in text for text in found) == asked


def test_a_robot_without_people_around_is_asked_about_none():
    assert texts(path=drive((0.0, 0.0, 0.0), (4.0, 2.0, 0.0))) == []


def carried(*corners, begin=2.0, end=20.0):
    """Order 1, and what the robot drove while it was aboard."""
    step = (end - begin) / (len(corners) - 1)
    ways = [(begin + step * n, *corner) for n, corner in enumerate(corners)]
    path = drive((0.0, *corners[0]), *ways, (end + 0.1, *corners[-1]), period=0.01)
    return order(1, waiting=1.0, picked_up=begin, delivered=end), path


@pytest.mark.parametrize(
    ("out", "line", "asked"),
    [
        (0.95, 1.0, False),
        (1.05, 1.0, True),
        (1.2, 5.0, False),
        (1.3, 5.0, True),
        (0.95, 1.8, False),
        (1.05, 1.8, True),
    ],
)
def test_a_way_is_asked_about_that_is_half_as_long_again_and_two_meters_longer(out, line, asked):
    row, path = carried((0.0, 0.0), (-out, 0.0), (line, 0.0))
    saw = f"From 2.0 to 20.0 s it drove {2 * out + line:.1f} m with order 1 aboard; the straight line is"
    assert any(text.startswith(saw) for text in texts(row, path=path)) == asked


def test_of_several_ways_the_one_is_asked_about_that_was_longer_by_most():
    first, path = carried((0.0, 0.0), (-2.0, 0.0), (1.0, 0.0), end=10.0)
    more = drive((11.0, 1.0, 0.0), (20.0, 7.0, 0.0), (25.0, 6.0, 0.0), (29.0, 7.0, 0.0))
    second = order(2, waiting=1.0, picked_up=11.0, delivered=29.0)
    assert [text for text in texts(first, second, path=[*path, *more]) if "it drove" in text] == [
        "From 2.0 to 10.0 s it drove 5.0 m with order 1 aboard; the straight line is 1.0 m"
    ]


CHARGES = [(0.0, 0.2), (1.0, 0.3), (2.0, 0.3), (5.0, 0.4), (12.0, 0.5), (13.0, 0.4), (20.0, 0.3), (23.0, 0.6)]


def test_the_longest_charge_is_asked_about_for_which_an_order_waited():
    saw = "From 2.0 to 12.0 s it charged, from 30% to 50%, while an order waited"
    assert saw in texts(order(1, waiting=1.0), path=drive(*HERE), battery=CHARGES)


@pytest.mark.parametrize(
    ("waiting", "picked_up", "asked"), [(9.0, 20.0, True), (9.9, 20.0, False), (9.0, 11.0, False)]
)
def test_a_charge_is_not_asked_about_where_no_order_waited_for_long(waiting, picked_up, asked):
    row = order(1, waiting=waiting, picked_up=picked_up)
    found = texts(row, path=drive(*HERE), battery=CHARGES[:5], seconds=30.0)
    assert any("it charged" in text for text in found) == asked


@pytest.mark.parametrize(("over", "asked"), [(20.0, False), (22.0, True)])
def test_an_order_waits_for_no_robot_that_carries_another_most_of_the_time(over, asked):
    second = order(2, waiting=3.0, delivered=over)
    found = texts(order(1, waiting=1.0, picked_up=2.0, delivered=12.0), second, path=drive(*HERE), seconds=40.0)
    assert (f"From 3.0 to {over:.1f} s it stood while order 2 waited, 0.0 m from shelf_1" in found) == asked


def test_a_canceled_order_is_asked_about_only_where_it_was_aboard():
    assert not any("canceled" in text for text in texts(order(1, waiting=1.0, canceled=5.0), path=drive(*HERE)))
    aboard = order(1, waiting=1.0, picked_up=2.0, canceled=5.0)
    assert "At 5.0 s order 1 was canceled, and it was aboard" in texts(aboard, path=drive(*HERE))


def test_where_nothing_was_delivered_the_oldest_order_is_asked_about_and_a_way_of_five_meters():
    rows = order(1, waiting=2.0), order(2, waiting=3.0)
    saw = "Order 1 came at 2.0 s and still waited at 8.0 s"
    assert texts(*rows, path=drive((0.0, 0.0, 0.0), (8.0, 4.9, 0.0)), seconds=8.0) == [saw]
    path = drive((0.0, 0.0, 0.0), (8.0, 5.1, 0.0))
    assert texts(*rows, path=path, seconds=8.0) == ["It drove 5 m and delivered nothing", saw]
    assert questions(worked(*rows, path=path, seconds=8.0))[0][:2] == (0.0, 8.0)


def test_where_something_was_delivered_no_order_that_waits_is_asked_about():
    rows = order(1, waiting=2.0, picked_up=3.0, delivered=8.0), order(2, waiting=3.0)
    path = drive((0.0, 0.0, 0.0), (8.0, 8.0, 0.0))
    assert texts(*rows, path=path, seconds=8.0) == ["Order 1 came at 2.0 s and took 6.0 s"]


def test_short_pauses_are_asked_about_where_there_is_little_else():
    path = drive((0.0, 0.0, 0.0), (4.0, 2.0, 0.0), (4.5, 2.0, 0.0), (8.0, 4.0, 0.0))
    assert "From 4.0 to 4.5 s it stood while order 1 waited, 0.5 m from the desk" in texts(
        LEFT, path=path, seconds=8.0
    )
    assert len(texts(LEFT, path=drive(*HERE), seconds=40.0)) == len(set(texts(LEFT, path=drive(*HERE), seconds=40.0)))
