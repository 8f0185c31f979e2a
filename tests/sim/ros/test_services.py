"""Services and parameters: every way to call, and who can be called from where."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, why
from tests.students.engine import services

BLOCKED = (
    "ask of node /customer has waited since t = 1 s and never returned, at line {}: {}. "
    "The response of service /add can only be handled {}"
)
CALL = 'node.say(f"sum {node.client.call(node.request()).sum}")'
SPIN = "rclpy.spin_until_future_complete(node, future)"
SAME_GROUP = "in the same callback group, after it has returned."
SAME_THREAD = "by the thread that waits for it."


def line_of(text):
    with open(services.__file__) as file:
        return next(number for number, line in enumerate(file, 1) if line.strip() == text)


def spin_line_in_a_callback():
    """The second line with these words after the function's first."""
    code = services.spin_in_a_callback.__code__
    ask = next(constant for constant in code.co_consts if hasattr(constant, "co_firstlineno"))
    return ask.co_firstlineno + 2


@pytest.mark.parametrize("adder", [services.Adder, services.AsyncAdder])
@pytest.mark.parametrize(
    "customer", [services.spin_once_until_done, services.done_callback, services.until_future_complete]
)
def test_an_answer_comes_at_once(adder, customer):
    recording = run(adder, customer, seconds=2, quiet=True)
    assert logged(recording) == [(0.0, "sum 5")]
    assert (recording.errors, recording.stderr) == ([], "")


def test_a_library_may_send_the_response_that_its_callback_does_not_return():
    recording = run(services.AnswersInPairs, services.until_future_complete, seconds=3, quiet=True)
    assert [call.response.sum for call in recording.calls] == [5]
    assert recording.errors == []


def test_a_client_waits_for_a_late_server():
    """rclpy looks for the server every 0.25 s."""
    recording = run(services.until_future_complete, services.late_adder, seconds=4, quiet=True)
    assert logged(recording) == [(1.0, "waiting"), (2.0, "waiting"), (2.5, "sum 5")]


def test_a_slow_service_takes_its_time():
    recording = run(services.SlowAdder, services.until_future_complete_with_timeout, seconds=4, quiet=True)
    stamps = [(round(stamp, 6), text) for stamp, text in logged(recording)]  # the clock is a float
    assert stamps == [(0.2, "done False"), (0.4, "done False"), (0.5, "done True")]


def test_answers_come_in_the_order_of_the_requests():
    recording = run(services.SlowAdder, services.many_calls, seconds=4, quiet=True)
    assert logged(recording) == [(0.5 * n, f"sum {n}") for n in range(1, 6)]


def test_without_a_server_nothing_comes():
    recording = run(services.no_one_answers, seconds=9, quiet=True)
    assert logged(recording) == [(1.5, "there False"), (2.5, "done False")]
    assert why(recording) == ("finished", 3.5, "Every program had ended by t = 2.5 s.")


@pytest.mark.parametrize("program", [services.multi_reentrant, services.await_reentrant])
def test_a_reentrant_group_lets_a_callback_wait_for_an_answer(program):
    recording = run(services.Adder, program, seconds=3, quiet=True)
    assert logged(recording) == [(1.0, "sum 5"), (2.0, "sum 5"), (3.0, "sum 5")]
    assert why(recording) == ("time", 3.0, "All 3 s were run.")


@pytest.mark.parametrize("program, reason", [
    (services.single_exclusive, SAME_GROUP),
    (services.multi_exclusive, SAME_GROUP),
    (services.single_reentrant, SAME_THREAD),
], ids=["single_exclusive", "multi_exclusive", "single_reentrant"])  # fmt: skip
def test_a_call_that_blocks_its_own_answer_is_named(program, reason):
    recording = run(services.Adder, program, seconds=3, quiet=True)
    assert why(recording) == ("blocked", 3.0, BLOCKED.format(line_of(CALL), CALL, reason))
    assert logged(recording) == []


def test_spinning_in_a_callback_blocks_in_the_default_group():
    recording = run(services.Adder, services.spin_in_a_callback, seconds=3, quiet=True)
    detail = BLOCKED.format(spin_line_in_a_callback(), SPIN, SAME_GROUP)
    assert why(recording) == ("blocked", 3.0, detail)


def test_awaiting_blocks_in_an_exclusive_group():
    recording = run(services.Adder, services.await_exclusive, seconds=3, quiet=True)
    detail = (
        "ask of node /customer has waited since t = 1 s and never returned. "
        "The response of service /add can only be handled in the same callback group, after it has returned."
    )
    assert why(recording) == ("blocked", 3.0, detail)


def test_the_graph_names_service_and_client():
    ends = run(services.Adder, services.done_callback, seconds=1, quiet=True).graph.endpoints
    named = [(end.kind, end.node, end.name, end.type) for end in ends]
    assert named == [
        ("service", "/adder", "/add", "example_interfaces/srv/AddTwoInts"),
        ("client", "/customer", "/add", "example_interfaces/srv/AddTwoInts"),
    ]


def test_parameters_are_declared_set_and_refused():
    assert logged(run(services.WheelThatSetsItself, seconds=1, quiet=True)) == [
        (0.0, "0.1 left"), (1.0, "0.2: True"), (1.0, "-1.0: False a radius is positive"), (1.0, "0.2 left"),
    ]  # fmt: skip


def test_parameters_are_reached_over_services():
    recording = run(services.Wheel, services.parameter_services, seconds=2, quiet=True)
    assert logged(recording) == [(0.0, "0.1 left"), (0.0, "radius 0.1"), (0.0, "set True")]


def test_a_call_that_is_watched_is_reported_in_four_events():
    recording = run(services.WatchesItself, seconds=2, quiet=True)
    assert (recording.errors, sorted(logged(recording))) == ([], [(1.0, str(kind)) for kind in range(4)])
