"""Every exception is kept: when, where, what, with the student's own lines; and the run goes on or ends."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, raised, why
from tests.students.engine import errors

pytestmark = pytest.mark.pythons

DIVISION = ("ZeroDivisionError", "division by zero")
INIT = "rclpy.init() has not been called. msg:cannot create node"
FIRST_ERROR = {
    errors.InTimer: (1.0, "/timer", "InTimer.tick", *DIVISION),
    errors.in_parallel_callback: (1.0, "/timer", "InTimer.tick", *DIVISION),
    errors.InSubscription: (1.5, "/listener", "InSubscription.on_message", "KeyError", "'speed'"),
    errors.InCoroutine: (1.0, "/coroutine", "InCoroutine.tick", "LookupError", "not awaited"),
    errors.InInit: (0.0, "/broken", "InInit", "AttributeError", "'InInit' object has no attribute 'missing'"),
    errors.InService: (
        1.0, "/server", "InService.answer", "AttributeError",
        "'Trigger_Response' object has no attribute 'missing'",
    ),
    errors.ServiceThatReturnsNothing: (
        1.0, "/server", "ServiceThatReturnsNothing.answer", "TypeError",
        "Expected <class 'example_interfaces.srv._trigger.Trigger_Response'>, got <class 'NoneType'>",
    ),
    errors.in_transition: (
        0.5, "/unready", "Unready.on_configure", "AttributeError",
        "'Unready' object has no attribute 'missing'",
    ),
    errors.in_main: (0.0, "/in_main", "in_main", "RuntimeError", "at once"),
    errors.in_thread: (0.0, "/threads", "thread work", "KeyError", "'in thread'"),
    errors.sys_exit_with_a_status: (1.0, "/leaver", "sys_exit_with_a_status", "SystemExit", "2"),
    errors.sys_exit_with_words: (0.0, "/sys_exit_with_words", "sys_exit_with_words", "SystemExit", "bye"),
    errors.os_exit_with_a_status: (0.0, "/os_exit_with_a_status", "os_exit_with_a_status", "SystemExit", "3"),
    errors.chained: (0.0, "/chained", "chained", "RuntimeError", "no number"),
    errors.init_twice: (
        0.0, "/init_twice", "init_twice", "RuntimeError", "Context.init() must only be called once",
    ),
    errors.unknown_arguments: (
        0.0, "/unknown_arguments", "unknown_arguments", "UnknownROSArgsError", "['--unknown']",
    ),
    errors.another_domain: (
        0.0, "/another_domain", "another_domain", "ValueError",
        "All programs of a run share one ROS domain and receive each other's messages: "
        "leave out domain_id=5.",
    ),
    errors.without_init: (0.0, "/forgot", "without_init", "NotInitializedException", INIT),
    errors.init_after_node: (0.0, "/early", "init_after_node", "NotInitializedException", INIT),
    errors.node_after_shutdown: (
        0.0, "/node_after_shutdown", "node_after_shutdown", "NotInitializedException", INIT,
    ),
    errors.shutdown_twice: (
        0.0, "/shutdown_twice", "shutdown_twice", "RuntimeError",
        "Context must be initialized before it can be shutdown",
    ),
    errors.own_context_shutdown_twice: (
        0.0, "/own_context_shutdown_twice", "own_context_shutdown_twice", "RCLError",
        "failed to shutdown: rcl_shutdown already called on the given context",
    ),
    errors.publish_after_shutdown: (
        0.0, "/late", "publish_after_shutdown", "RCLError",
        "Failed to publish: publisher's context is invalid",
    ),
    errors.asks_the_keyboard: (
        0.0, "/asker", "asks_the_keyboard", "RuntimeError",
        "input() waits for a person at the keyboard; give it lines, as in run(Process(main, "
        'stdin=["first line", "second line"])), or let the node get its input from topics and parameters',
    ),
    errors.events_executor: (
        0.0, "/events_executor", "events_executor", "NotImplementedError",
        "EventsExecutor can't run in simulated time. Use SingleThreadedExecutor or MultiThreadedExecutor.",
    ),
    errors.starts_a_run: (
        0.0, "/starts_a_run", "starts_a_run", "RuntimeError",
        "run() can't start another run here: this is a node of a run in progress.",
    ),
    errors.wrong_qos: (
        0.0, "/qos", "wrong_qos", "TypeError",
        "Expected QoSProfile or int, but received <class 'str'>",
    ),
    errors.bad_topic_name: (
        0.0, "/names", "bad_topic_name", "InvalidTopicNameException",
        "Invalid topic name: topic name must not contain characters other than alphanumerics, '_', '~', "
        "'{', or '}':\n  'my topic'\n     ^",
    ),
    errors.no_callback: (1.0, "/called", "str", "TypeError", "'str' object is not callable"),
    errors.timer_callback_with_argument: (
        1.0, "/arguments", "<lambda>", "TypeError",
        "timer_callback_with_argument.<locals>.<lambda>() missing 1 required positional argument: 'msg'",
    ),
    errors.needs_argument: (
        0.0, "/needs_argument", "needs_argument", "TypeError",
        "needs_argument() missing 1 required positional argument: 'robot'",
    ),
    errors.WithoutSuper: (
        0.0, "/WithoutSuper", "WithoutSuper", "AttributeError",
        "'WithoutSuper' object has no attribute '_default_callback_group'",
    ),
}  # fmt: skip


@pytest.mark.parametrize("program", FIRST_ERROR, ids=lambda program: program.__name__)
def test_an_exception_is_kept_and_ends_its_program(program):
    recording = run(program, seconds=3, quiet=True)
    error = FIRST_ERROR[program]
    _, node, callback, kind, text = error
    assert raised(recording) == [error]
    assert recording.ended.reason == "error"
    assert recording.ended.detail == f"{callback} of {node} raised {kind}: {text}"
    assert recording.stderr == ""


def test_an_exception_without_words_ends_the_sentence_with_its_name():
    ended = run(errors.WithoutWords, seconds=3, quiet=True).ended
    assert ended.detail == "WithoutWords.tick of /timer raised NotImplementedError"


def test_a_traceback_shows_the_authors_lines_and_no_others():
    (error,) = run(errors.InTimer, seconds=3, quiet=True).errors
    file = errors.__file__
    lines = [line for line in error.traceback.splitlines() if line.strip(" ~^")]
    first = errors.InTimer.tick.__code__.co_firstlineno + 1
    second = errors.InTimer.divide.__code__.co_firstlineno + 1
    assert lines[:2] == [f'  File "{file}", line {first}, in tick', "    self.divide(0)"]
    assert lines[2:4] == [f'  File "{file}", line {second}, in divide', "    return 1 / number"]
    assert lines[-1] == "ZeroDivisionError: division by zero"
    assert [line for line in lines if line.startswith("  File")] == [lines[0], lines[2]]


def test_an_exception_that_its_program_catches_is_kept_too():
    recording = run(errors.caught, seconds=3, quiet=True)
    assert logged(recording) == [(1.0, "caught: division by zero"), (2.0, "caught: division by zero")]
    assert raised(recording) == [(stamp, "/timer", "InTimer.tick", *DIVISION) for stamp in (1.0, 2.0)]


def test_an_exception_in_a_thread_leaves_its_program_alive():
    recording = run(errors.in_thread, seconds=3, quiet=True)
    assert [stamp for stamp, _ in logged(recording)] == [1.0, 2.0, 3.0]


def test_an_exception_in_a_transition_leaves_its_program_alive():
    assert logged(run(errors.in_transition, seconds=3, quiet=True)) == [(0.5, "ERROR")]


def test_a_program_that_fails_leaves_the_others_alive():
    from tests.students.engine import mains

    recording = run(errors.in_main, mains.Counter, seconds=3, quiet=True)
    assert len(recording.messages("/count")) == 6
    assert why(recording) == ("error", 3.0, "in_main of /in_main raised RuntimeError: at once")


@pytest.mark.parametrize("program", [errors.sys_exit, errors.os_exit, errors.sys_exit_in_a_thread])
def test_leaving_the_program_without_a_status_ends_it_and_nothing_else(program):
    recording = run(program, seconds=3, quiet=True)
    assert why(recording) == ("finished", 1.0, "Every program had ended by t = 0 s.")
    assert raised(recording) == []


def test_an_exception_without_a_text_is_kept():
    (error,) = run(errors.odd_exception, seconds=3, quiet=True).errors
    assert (error.callback, error.type) == ("odd_exception", "Odd")


def test_an_exception_in_a_task_names_the_task():
    recording = run(errors.InTask, seconds=3, quiet=True)
    assert raised(recording) == [(1.0, "/tasks", "InTask.work", "OSError", "no such device")]


@pytest.mark.parametrize("program", errors.ON_PURPOSE, ids=lambda program: program.__name__)
def test_an_exception_that_ends_spin_on_purpose_is_no_error(program):
    recording = run(program, seconds=2, quiet=True)
    assert (recording.errors, logged(recording)) == ([], [(0.5, "went on")])
    assert why(recording) == ("finished", 1.5, "Every program had ended by t = 0.5 s.")


@pytest.mark.parametrize("program", errors.CAUGHT, ids=lambda program: program.__name__)
def test_one_that_is_caught_by_chance_or_raised_again_is_an_error(program):
    recording = run(program, seconds=2, quiet=True)
    (error,) = recording.errors
    assert error.callback in ("raises_again" if program is errors.raises_again else "finish", "<lambda>")
    assert (recording.ended.reason, logged(recording)) == ("error", [(0.5, "went on")])
