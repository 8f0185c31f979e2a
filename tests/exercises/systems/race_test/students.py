"""Tests of depots: right ones, and wrong ones named after their defect."""

import inspect
import itertools
import random
import time
import unittest
from collections import Counter

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty, Int32

from sim import explore, run

PARTS = (
    *("Users", "Plenty", "Lone", "Drawn", "Arrivals", "Takers", "Other", "numbers", "problems", "at_pauses"),
    *("pauses", "Case", "other_program"),
)
ORDERS = range(20)


class Users(Node):
    """Robots that bring and take boxes; 0.1 s after each burst they publish a pause."""

    def __init__(self):
        super().__init__("users")
        self.arrive = self.create_publisher(Int32, "/arrive", 100)
        self.take = self.create_publisher(Int32, "/take", 100)
        self.pause = self.create_publisher(Empty, "/pause", 100)
        self.turn = 0
        self.create_timer(0.1, self.next_turn)

    def next_turn(self):
        if not (self.arrive.get_subscription_count() and self.take.get_subscription_count()):
            return
        self.turn += 1
        if self.turn % 2 == 1:
            self.burst()
        else:
            self.pause.publish(Empty())

    def burst(self):
        for number in (2, 2, 3):
            self.arrive.publish(Int32(data=number))
            for wanted in (2, 1, 2):
                self.take.publish(Int32(data=wanted))


def numbers(recording, topic):
    return [received.message.data for received in recording.messages(topic)]


def pauses(recording):
    return [recording.during(0.0, pause.stamp) for pause in recording.messages("/pause")]


def problems(part, answers=True, negative=True, last=True):
    """What is wrong with a part of a recording that ends at a pause."""
    arrived, wanted = numbers(part, "/arrive"), numbers(part, "/take")
    taken, stock = numbers(part, "/taken"), numbers(part, "/stock")
    there = sum(arrived) - sum(taken)
    found = {
        f"{len(taken)} answers to {len(wanted)} requests": answers and len(taken) != len(wanted),
        f"{min(stock, default=-1)} boxes": negative and min(stock, default=-1) < 0,
        f"{stock[-1:]} instead of {there} boxes": last and stock[-1:] != [there],
    }
    return [text for text, wrong in found.items() if wrong]


def at_pauses(program, users=Users, orders=ORDERS, seconds=2.5, **lines):
    for order in orders:
        for part in pauses(run(program, users, seconds=seconds, order=order, quiet=True, expect_error=True)):
            assert problems(part, **lines) == []


def asserts_at_each_pause(program):
    at_pauses(program)


def explores(program):
    """Hands the search over to `explore`."""

    def holds(recording):
        return not any(map(problems, pauses(recording)))

    found = explore(program, Users, holds=holds, orders=24, seconds=2.5)
    assert found.failed is None, found.explanation


class Drawn(Users):
    """Sends something else in each burst."""

    def burst(self):
        for _ in range(random.randrange(6, 14)):
            publisher = random.choice([self.arrive, self.take, self.take])
            publisher.publish(Int32(data=random.randrange(1, 4)))


def draws_its_bursts(program):
    """A design of its own: each order is also another seed, from which the bursts are drawn."""
    for order in range(24):
        recording = run(program, Drawn, seconds=2.5, seed=order, order=order, quiet=True)
        parts = [part for part in pauses(recording) if numbers(part, "/arrive") or numbers(part, "/taken")]
        assert not any(problems(part, negative=bool(numbers(part, "/stock")), last=False) for part in parts)
        for part in parts:
            stock = numbers(part, "/stock") or [0]
            assert stock[-1] == sum(numbers(part, "/arrive")) - sum(numbers(part, "/taken"))


class Arrivals(Users):
    """Only brings boxes."""

    def burst(self):
        for number in (2, 2, 3):
            self.arrive.publish(Int32(data=number))


class Takers(Users):
    """Only takes boxes, in a program of its own."""

    def __init__(self):
        super().__init__()
        self.destroy_publisher(self.pause)
        self.pause = self.create_publisher(Empty, "/pause_of_takers", 100)

    def burst(self):
        for wanted in (2, 1, 2, 2, 1, 2, 2):
            self.take.publish(Int32(data=wanted))


def sends_from_two_programs(program):
    """A design of its own: the robots that bring boxes and those that take them are two programs.

    They don't pause at the same time, so it looks after 0.1 s without a message from either.
    """
    for order in range(24):
        recording = run(program, Arrivals, Takers, seconds=2.5, order=order, quiet=True)
        sent = sorted(row.stamp for topic in ("/arrive", "/take") for row in recording.messages(topic))
        quiet = [before + 0.1 for before, after in itertools.pairwise(sent) if after > before + 0.11]
        for part in (recording.during(0.0, stamp) for stamp in quiet):
            assert problems(part, negative=False, last=False) == []
            stock = numbers(part, "/stock")
            assert all(number >= 0 for number in stock)
            if stock:
                assert stock[-1] == sum(numbers(part, "/arrive")) - sum(numbers(part, "/taken"))


class Case(unittest.TestCase):
    """Compares the change between two pauses."""

    def runTest(self):
        pass


def compares_changes(program):
    """A design of its own: looks at each burst alone, with the assertions of unittest."""
    case = Case()
    for order in ORDERS:
        recording = run(program, Users, seconds=2.5, order=order, quiet=True)
        begin, before = 0.0, 0
        for pause in recording.messages("/pause"):
            part = recording.during(begin, pause.stamp)
            wanted, taken = Counter(numbers(part, "/take")), Counter(numbers(part, "/taken"))
            del taken[0]
            case.assertLessEqual(taken, wanted)
            case.assertEqual(len(numbers(part, "/taken")), wanted.total())
            case.assertGreaterEqual(min(numbers(part, "/stock")), 0)
            now = numbers(part, "/stock")[-1]
            case.assertEqual(now - before, sum(numbers(part, "/arrive")) - sum(numbers(part, "/taken")))
            begin, before = pause.stamp, now


def collects_all_problems(program):
    """Notes everything that is wrong in all runs, and fails once."""
    found = []
    for order in ORDERS:
        for part in pauses(run(program, Users, seconds=2.5, order=order, quiet=True)):
            found += [(order, text) for text in problems(part)]
    if found:
        pytest.fail(f"{len(found)} problems, the first in order {found[0]}")


def stops_a_run_early(program):
    """A design of its own: `until` looks while the run goes on, and ends it at the first problem."""
    for order in ORDERS:
        seen, wrong = [0], []

        def is_wrong(recording, seen=seen, wrong=wrong):
            found = recording.messages("/pause")
            if len(found) > seen[0]:
                seen[0] = len(found)
                wrong.extend(problems(recording.during(0.0, found[-1].stamp)))
            return bool(wrong)

        run(program, Users, seconds=2.5, order=order, quiet=True, until=is_wrong)
        assert not wrong


def orders_of_one_machine(program):
    """Varies only what varies on one machine."""
    at_pauses(program, orders=[f"host-{number}" for number in range(24)])


def not_started(program):
    raise NotImplementedError


def fails_always(program):
    run(program, Users, seconds=1, quiet=True)
    raise AssertionError("it has a race")


def passes_always(program):
    at_pauses(program, answers=False, negative=False, last=False)


def returns_what_it_found(program):
    for order in ORDERS:
        recording = run(program, Users, seconds=2.5, order=order, quiet=True)
        if any(map(problems, pauses(recording))):
            return False
    return True


def usual_order_only(program):
    at_pauses(program, orders=[0])


def one_order_only(program):
    at_pauses(program, orders=["6"])


class Lone(Users):
    def burst(self):
        (self.take if self.turn % 4 == 1 else self.arrive).publish(Int32(data=2))


def one_message_at_a_time(program):
    at_pauses(program, users=Lone)


class Plenty(Users):
    def burst(self):
        for _ in range(4):
            self.arrive.publish(Int32(data=20))
            self.take.publish(Int32(data=1))


def always_enough_boxes(program):
    at_pauses(program, users=Plenty)


def no_look_at_answers(program):
    at_pauses(program, answers=False)


def no_look_at_negative_numbers(program):
    at_pauses(program, negative=False)


def no_look_at_the_last_number(program):
    at_pauses(program, last=False)


def looks_at_the_end_only(program):
    for order in ORDERS:
        recording = run(program, Users, seconds=2.5, order=order, quiet=True)
        assert problems(pauses(recording)[-1]) == []


def looks_at_once(program):
    for order in ORDERS:
        recording = run(program, Users, seconds=2.5, order=order, quiet=True)
        for pause in recording.messages("/pause"):
            assert problems(recording.during(0.0, pause.stamp - 0.09)) == []


def no_number_twice(program):
    at_pauses(program)
    stock = numbers(run(program, Users, seconds=2.5, quiet=True), "/stock")
    assert all(before != after for before, after in itertools.pairwise(stock))


def looks_at_the_source(program):
    assert "Lock" in inspect.getsource(inspect.getmodule(program) or program)


def runs_it_and_looks_at_the_source(program):
    run(program, Users, seconds=1, quiet=True)
    lines, _ = inspect.findsource(program)
    text = "".join(lines).partition("class")[2]
    assert any(word in text for word in ("Lock", "Condition", "Queue", "Exclusive", "Single"))


class Other(Node):
    """A depot that never has a box."""

    def __init__(self):
        super().__init__("other")
        self.levels = self.create_publisher(Int32, "/stock", 100)
        self.create_subscription(Int32, "/arrive", self.levels.publish, 100)
        self.create_subscription(Int32, "/take", self.levels.publish, 100)


def other_program():
    rclpy.init()
    rclpy.spin(Other())


def tests_a_program_of_its_own(program):
    at_pauses(other_program, orders=[0])


def sleeps(program):
    for order in ORDERS:
        recording = run(program, Users, seconds=2.5, order=order, quiet=True)
        time.sleep(0.1)
        assert not any(map(problems, pauses(recording)))


def a_hundred_orders(program):
    at_pauses(program, orders=range(100))


def misspelled(program):
    recording = run(program, Users, seconds=2.5, quiet=True)
    assert recording.mesages("/taken")
