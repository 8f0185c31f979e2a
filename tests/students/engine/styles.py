"""One small task, written in every style that Python allows: count to three on /count, twice a second."""

import asyncio  # noqa: F401  (students import what they don't use)
from dataclasses import dataclass, field
from functools import partial, wraps

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Base(Node):
    """The first class of a hierarchy: it knows the topic."""

    def __init__(self, name="styled"):
        super().__init__(name)
        self.publisher = self.create_publisher(Int32, "count", 10)

    def send(self, number):
        if number <= 3:
            self.publisher.publish(Int32(data=number))


class Middle(Base):
    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.tick)
        self.number = 0

    def tick(self):
        self.number += 1
        self.send(self.number)


class Hierarchy(Middle):
    """Overrides a callback of its base class."""

    def tick(self):
        super().tick()


class Mixin:
    def begin(self):
        self.numbers = iter(range(1, 4))
        self.create_timer(0.5, self.tick)


class MixedIn(Mixin, Base):
    def __init__(self):
        super().__init__()
        self.begin()

    def tick(self):
        self.send(next(self.numbers, 4))


class Generator(Base):
    """The state is a generator's."""

    def __init__(self):
        super().__init__()
        self.steps = self.counting()
        self.create_timer(0.5, lambda: next(self.steps, None))

    def counting(self):
        for number in (1, 2, 3):
            self.send(number)
            yield


class Partial(Base):
    def __init__(self):
        super().__init__()
        state = [0]
        self.create_timer(0.5, partial(self.tick, state))

    def tick(self, state):
        state[0] += 1
        self.send(state[0])


class CallableObject(Base):
    class Tick:
        def __init__(self, node):
            self.node, self.number = node, 0

        def __call__(self):
            self.number += 1
            self.node.send(self.number)

    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.Tick(self))


@dataclass
class State:
    number: int = 0
    sent: list = field(default_factory=list)


class Dataclass(Base):
    def __init__(self):
        super().__init__()
        self.state = State()
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.state.number += 1
        self.state.sent.append(self.state.number)
        self.send(self.state.number)


def logged(function):
    @wraps(function)
    def wrapper(*arguments, **keywords):
        return function(*arguments, **keywords)

    return wrapper


class Decorated(Middle):
    @logged
    def tick(self):
        super().tick()


class Coroutine(Middle):
    async def tick(self):
        super().tick()


class Slots(Base):
    __slots__ = ("number",)

    def __init__(self):
        super().__init__()
        self.number = 0
        self.create_timer(0.5, self.tick)

    @property
    def next(self):
        self.number += 1
        return self.number

    def tick(self):
        self.send(self.next)


class TwoNodes(Base):
    """A node that makes a helper node and lets it publish."""

    def __init__(self):
        super().__init__()
        self.helper = Node("helper")
        self.number = 0
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.number += 1
        self.send(self.number)


def closure():
    rclpy.init()
    node = Base()
    number = 0

    def tick():
        nonlocal number
        number += 1
        node.send(number)

    node.create_timer(0.5, tick)
    rclpy.spin(node)


count = 0


def module_globals():
    global count
    count = 0
    rclpy.init()
    node = Base()

    def tick():
        global count
        count += 1
        node.send(count)

    node.create_timer(0.5, tick)
    rclpy.spin(node)


def walrus_loop():
    rclpy.init()
    node = Base()
    number = 0
    while (number := number + 1) <= 3:
        rclpy.spin_once(node, timeout_sec=0.5)
        node.send(number)


def class_in_function():
    class Local(Middle):
        pass

    rclpy.init()
    rclpy.spin(Local())


class Program:
    """A main() that is a method."""

    def __init__(self, name):
        self.name = name

    def main(self):
        rclpy.init()
        node = Base(self.name)
        numbers = iter(range(1, 100))
        node.create_timer(0.5, lambda: node.send(next(numbers)))
        rclpy.spin(node)


bound_method = Program("styled").main
made_by_lambda = lambda: Middle()  # noqa: E731  (students write such lines)
partial_of_a_function = partial(Program("styled").main)
ALL = [
    Middle, Hierarchy, MixedIn, Generator, Partial, CallableObject, Dataclass, Decorated, Coroutine, Slots,
    TwoNodes, closure, module_globals, walrus_loop, class_in_function, bound_method, made_by_lambda,
    partial_of_a_function,
]  # fmt: skip
