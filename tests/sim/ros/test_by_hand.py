"""Tests of `schedule`: a person picks which callback continues next."""

import re
import threading

import pytest
from rclpy.node import Node
from std_msgs.msg import Float64

from sim import schedule


class Courier(Node):
    """Checks and acts in one callback, and changes what is checked in another."""

    def __init__(self):
        super().__init__("courier")
        self.driving = True
        self.publisher = self.create_publisher(Float64, "speed", 10)

    def drive(self):
        if self.driving:
            self.publisher.publish(Float64(data=0.3))

    def stop(self):
        self.driving = False
        self.publisher.publish(Float64(data=0.0))


class Doors(Node):
    """Two callbacks that take two locks, each in another order."""

    def __init__(self):
        super().__init__("doors")
        self.first, self.second = threading.Lock(), threading.Lock()
        self.count = 0

    def enter(self):
        with self.first:  # noqa: SIM117
            with self.second:
                self.count += 1

    def leave(self):
        """Take the locks the other way around."""
        with self.second:  # noqa: SIM117
            with self.first:
                self.count -= 1


class Adds(Node):
    """Adds what it is given, in several ways that a function can be written."""

    def __init__(self):
        super().__init__("adds")
        self.sum = None

    def begin(self):
        self.sum = 0

    def add(self, number, twice=False):
        """Add it, once or twice."""
        try:
            for _ in range(2 if twice else 1):
                self.sum += number
        finally:
            self.ended = True


class Waits(Node):
    """Callbacks that wait, or can't be picked at all."""

    def __init__(self):
        super().__init__("waits")
        self.lock, self.set = threading.Lock(), threading.Event()
        self.count = self.managers = 0

    def acquire(self):
        self.lock.acquire()
        self.count += 1
        self.lock.release()

    def manager(self):
        self.managers += 1
        return self.lock

    def enter(self):
        with self.manager():
            self.count += 1

    def wait(self):
        self.set.wait()

    def loop(self):
        while True:
            self.count += 1

    async def resume(self):
        """Come back later."""

    def produce(self):
        yield self.count


class Inherits(Adds):
    """Its callback uses `super()`."""

    def add(self, number):
        super().add(number)


def stopped(recording):
    """The last speed is 0."""
    return recording.messages("/speed")[-1].message.data == 0.0


def no_errors(recording):
    return not recording.errors


def played(game, *picks):
    """The last sentence after these picks."""
    for number in picks:
        game.pick(number)
    return game.position.text


def test_a_race_between_two_lines_is_played_by_hand():
    game = schedule(Courier, "drive", "stop", holds=stopped, threads=True)
    assert repr(game) == "Pick 1 or 2."
    assert played(game, 1, 2, 2, 1) == "All callbacks are done. It doesn't hold: you broke it."
    assert game.broken_after == [1, 2, 2, 1]
    first = game.position.lines[0][0][0]
    assert game.position.done[0] == f"1 drive() line {first + 1}"
    assert game.position.values == {"driving": "False"}


def test_an_order_in_which_it_holds_is_no_end():
    game = schedule(Courier, "drive", "stop", holds=stopped, threads=True)
    assert played(game, 1, 1, 2, 2) == "All callbacks are done. It still holds. Try another order."
    assert game.position.holds is True
    assert game.undo().text == "Pick 2."
    assert game.restart().text == "Pick 1 or 2."
    assert game.undo().text == "Pick 1 or 2."


def test_without_threads_a_pick_runs_a_whole_callback():
    game = schedule(Courier, "drive", "stop", holds=stopped)
    assert played(game, 2, 1) == "All callbacks are done. It still holds. Try another order."
    assert game.position.done == ["2 stop()", "1 drive()"]


def test_a_callback_that_waits_for_a_lock_can_not_be_picked():
    game = schedule(Doors, "enter", "leave", holds=no_errors, threads=True)
    assert played(game, 1) == "Pick 1 or 2."
    assert [call.state for call in game.position.calls] == ["running", "waiting"]
    game.restart()
    assert played(game, 2, 2) == "Pick 2."
    assert [call.state for call in game.position.calls] == ["blocked", "running"]


def test_a_deadlock_is_named():
    game = schedule(Doors, "enter", "leave", holds=no_errors, threads=True)
    assert played(game, 1, 2) == (
        "Each callback that isn't done waits for a lock that another one holds: a deadlock. "
        "It doesn't hold: you broke it."
    )
    assert game.position.choices == []


def test_messages_of_one_callback_keep_their_order():
    game = schedule(Adds, "begin", ("add", 1), ("add", 2), holds=no_errors)
    assert game.position.choices == [1, 2]
    with pytest.raises(ValueError, match=re.escape("3 can't be picked now. Possible: 1 or 2.")):
        game.pick(3)
    played(game, 1, 2, 3)
    assert game.position.values["sum"] == "3"
    words = "1 can't be picked now. Possible: none: undo, or start again."
    with pytest.raises(ValueError, match=re.escape(words)):
        game.pick(1)


def test_a_callback_that_fails_ends_the_order():
    game = schedule(Adds, ("add", 1), "begin", holds=no_errors)
    text = played(game, 1)
    assert text.startswith("add() fails: TypeError: unsupported operand")
    assert text.endswith("It doesn't hold: you broke it.")
    assert game.position.choices == []


def test_loops_handlers_and_defaults_run_line_by_line():
    game = schedule(Adds, "begin", ("add", 3, True), holds=no_errors, threads=True)
    played(game, 1)
    steps = 0
    while game.position.choices:
        game.pick(2)
        steps += 1
    assert steps == 5  # try, for, twice the sum, and the end
    assert game.position.values == {"sum": "6", "ended": "True"}


def test_a_callback_is_left_in_its_middle():
    game = schedule(Doors, "enter", "leave", holds=no_errors, threads=True)
    played(game, 1, 1)
    game = schedule(Adds, "begin", ("add", 3, True), holds=no_errors, threads=True)
    played(game, 1, 2, 2)
    assert game.position.values == {"sum": "0"}  # as it was before it was left
    assert game.position.recording.errors == []


def test_a_callback_that_uses_super_runs_as_a_whole():
    game = schedule(Inherits, "begin", ("add", 3), holds=no_errors, threads=True)
    assert played(game, 1, 2) == "All callbacks are done. It still holds. Try another order."


def test_what_can_not_be_played_is_refused():
    with pytest.raises(ValueError, match=re.escape('such as "on_timer" or ("on_scan", scan).')):
        schedule(Courier, holds=stopped)
    with pytest.raises(ValueError, match=r"The node can't be created: .*no_such"):
        schedule(lambda: Courier().no_such, "drive", holds=stopped)


ASYNC = "() is async or has a yield: `schedule` runs callbacks that are ordinary methods."


@pytest.mark.parametrize(
    ("call", "words"),
    [
        ("no_such", "The node has no method no_such()."),
        ("resume", f"resume{ASYNC}"),
        ("produce", f"produce{ASYNC}"),
        (("wait", 1), "wait() can't be called with what it is given: too many positional arguments."),
        (5, 'schedule needs callbacks that are due, such as "on_timer" or ("on_scan", scan).'),
    ],
)
@pytest.mark.parametrize("threads", [True, False])
def test_a_callback_that_can_not_be_called_is_refused(call, words, threads):
    with pytest.raises(ValueError, match=f"^{re.escape(words)}$"):
        schedule(Waits, call, holds=no_errors, threads=threads)


def test_a_lock_that_is_acquired_without_a_with_blocks_the_other_callback():
    game = schedule(Waits, "acquire", "acquire", holds=no_errors, threads=True)
    assert played(game, 1) == "Pick 1."
    assert played(game, 1, 1, 2, 2, 2) == "All callbacks are done. It still holds. Try another order."
    assert game.position.values["count"] == "2"


def test_what_a_with_calls_is_called_once():
    game = schedule(Waits, "enter", holds=no_errors, threads=True)
    played(game, 1, 1)
    assert game.position.values["managers"] == "1"


@pytest.mark.parametrize(("call", "threads"), [("wait", True), ("wait", False), ("loop", False)])
def test_a_callback_that_does_not_go_on_is_no_order_in_which_it_holds(call, threads):
    game = schedule(Waits, call, holds=no_errors, threads=threads)
    assert played(game, 1) == (
        f"{call}() doesn't go on: it loops, or waits inside a statement, where no other callback can run. "
        "Undo."
    )
    assert (game.position.holds, game.position.choices) == (None, [])
    assert game.undo().text == "Pick 1."
