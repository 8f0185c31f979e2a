"""Invalid data from the other process ends the run with one sentence, and none of it is recorded."""

import contextlib
import math
import socket
import threading

import pytest
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import String

from sim import run
from sim.ros.messages.codec import encode
from sim.ros.remote import Remote, RemoteLost, Wire, WireError
from tests.patience import PATIENCE

END = 1_000_000_000  # ns
QUIET = {
    "events": [],
    "self_reports": {},
    "next": END,
    "busy": False,
    "alive": True,
    "fault": None,
    "blocked": "",
}
ENDED = {"stderr": ""}
QOS = [10, 1, 2, 1, 0, 0, 0, 0]


TWIST = encode(Twist())
TOO_SHORT = b"\0\1\0\0\xff\xff\xff\xff"  # a text that would be longer
TALKS = ["endpoint", 1, 3, "/talker", "publisher", "/chat", "std_msgs/msg/String", QOS]
SERVES = ["endpoint", 11, 3, "/talker", "service", "/add", "example_interfaces/srv/AddTwoInts", QOS]
ASKS = ["endpoint", 5, 3, "/talker", "client", "/add", "example_interfaces/srv/AddTwoInts", QOS]
ACTS = ["endpoint", 7, 3, "/talker", "action client", "/fib", "example_interfaces/action/Fibonacci", None]
CALL = ["call", 9, "/add", "example_interfaces/srv/AddTwoInts", "/talker", True, TWIST, False]
ID = "00" * 16


@contextlib.contextmanager
def answering(*answers, after=QUIET, over=ENDED, deadline=None):
    """A Remote whose process gives these answers, one each turn, and then `after`."""
    near, far = socket.socketpair()
    wire, left = Wire(far), list(answers)

    def answer():
        with contextlib.suppress(WireError):
            while True:
                do = wire.receive()["do"]
                if do in ("go", "call"):
                    wire.send(**(left.pop(0) if left else after))
                elif do == "over":
                    wire.send(**over)

    thread = threading.Thread(target=answer)
    thread.start()
    remote = Remote(Wire(near), patience=PATIENCE, deadline=deadline)
    try:
        yield remote
    finally:
        remote.wire.close()
        thread.join()
        wire.close()


def reason_for(*answers, over=ENDED) -> str:
    """The reason for which a process with these answers is given up."""
    with answering(*answers, over=over) as remote, pytest.raises(RemoteLost) as lost:
        run(remote, seconds=1, quiet=True)
    return lost.value.reason


def answer_with(*events) -> dict:
    return QUIET | {"events": list(events)}


def self_reports(**kinds) -> dict:
    return QUIET | {"self_reports": kinds}


def sent(reason: str) -> str:
    return f"The process with the nodes sent {reason}."


def test_a_process_without_events_completes_the_run():
    with answering() as remote:
        recording = run(remote, seconds=1, quiet=True)
    assert (recording.ended.reason, recording.ended.stamp) == ("time", 1.0)


@pytest.mark.parametrize(
    ("events", "words"),
    [
        ([["dance"]], "an event of unknown kind"),
        ([[]], "an event of unknown kind"),
        ([5], "an event of unknown kind"),
        ([[["endpoint"]]], "an event of unknown kind"),
        ([["endpoint", 1]], "the event 'endpoint' with 1 parts, not 7"),
        ([TALKS, TALKS], "the endpoint '/chat' of '/talker', which is invalid"),
        ([[*TALKS[:3], "talker", *TALKS[4:]]], "the endpoint '/chat' of 'talker', which is invalid"),
        ([[*TALKS[:3], "/tal ker", *TALKS[4:]]], "the name '/chat' or '/tal ker', which ROS does not allow"),
        ([[*TALKS[:5], "/ch at", *TALKS[6:]]], "the name '/ch at' or '/talker', which ROS does not allow"),
        (
            [[*SERVES[:5], "/ad d", *SERVES[6:]]],
            "the name '/ad d' or '/talker', which ROS does not allow",
        ),
        ([["endpoint", "1", *TALKS[2:]]], "a number that is not an integer from 0 to 9223372036854775807"),
        ([["endpoint", True, *TALKS[2:]]], "a number that is not an integer from 0 to 9223372036854775807"),
        ([[*TALKS[:4], "robot", *TALKS[5:]]], "an endpoint of unknown kind"),
        ([[*TALKS[:4], ["client"], *TALKS[5:]]], "an endpoint of unknown kind"),
        ([[*TALKS[:6], "os/msg/Path", QOS]], "the type os/msg/Path, which is not installed here"),
        ([[*TALKS[:6], "std_msgs/msg/Nope", QOS]], "the type std_msgs/msg/Nope, which is not installed here"),
        ([[*TALKS[:6], "tests/msg/String", QOS]], "the type tests/msg/String, which is not installed here"),
        ([[*TALKS[:6], "../x", QOS]], "the type '../x', which is not the name of a msg type"),
        (
            [[*TALKS[:6], "std_srvs/srv/SetBool", QOS]],
            "the type 'std_srvs/srv/SetBool', which is not the name of a msg type",
        ),
        ([[*TALKS[:7], None]], "a QoS profile that are not a list"),
        ([[*TALKS[:7], [10]]], "an incomplete QoS profile"),
        ([[*TALKS[:7], [10, 99, *QOS[2:]]]], "the unknown reliability 99"),
        ([[*TALKS[:7], [-1, *QOS[1:]]]], "a depth that is not an integer from 0 to 100000"),
        ([["destroyed", [77]]], "the destruction of an endpoint that does not exist"),
        ([["destroyed", 77]], "numbers that are not a list"),
        (
            [["message", "/talker", "/chat", TWIST, False]],
            "a message on '/chat', where '/talker' has no publisher",
        ),
        (
            [TALKS, ["message", "/robot", "/chat", TWIST, False]],
            "a message on '/chat', where '/robot' has no publisher",
        ),
        (
            [TALKS, ["liveliness", "/robot", "/chat"]],
            "a liveliness assertion on '/chat', where '/robot' has no publisher",
        ),
        ([TALKS, ["delivered", 1, "AA", 0, 1, 0, 0]], "an event of unknown kind"),
        ([TALKS, ["liveliness delivered", 1, "/talker"]], "an event of unknown kind"),
        (
            [TALKS, ["message", "/talker", "/chat", "AA", False]],
            "a message on /chat that is not of type std_msgs/msg/String",
        ),
        (
            [TALKS, ["message", "/talker", "/chat", 5, False]],
            "a message on /chat that is not of type std_msgs/msg/String",
        ),
        (
            [TALKS, ["message", "/talker", "/chat", "é", False]],
            "a message on /chat that is not of type std_msgs/msg/String",
        ),
        (
            [TALKS, ["message", "/talker", "/chat", TOO_SHORT, True]],
            "a message on /chat that is not of type std_msgs/msg/String",
        ),
        (
            [["request", 11, "/add", "/talker", TWIST]],
            "a request to '/add', of which '/talker' has no client",
        ),
        (
            [ASKS, ["request", 11, "/add", "/talker", "AAEAAA=="]],
            "a request to /add that is not of type example_interfaces/srv/AddTwoInts_Request",
        ),
        ([["response", 2, TWIST]], "a response to a request that no client has sent"),
        ([[*CALL[:6], "", False]], "a request that is not of type example_interfaces/srv/AddTwoInts_Request"),
        ([ASKS, ["call", 8, *CALL[2:]]], "a key that it may not choose"),
        ([CALL], "a report on the node '/talker', which it does not have"),
        ([ASKS, CALL, CALL], "a key that it may not choose"),
        ([["call started", 9, "/adder"]], "a report on a call that does not exist"),
        (
            [ASKS, CALL, ["call started", 9, "/adder"]],
            "a report on the node '/adder', which it does not have",
        ),
        (
            [ASKS, CALL, ["call answered", 9, "AAEAAA=="]],
            "a response that is not of type example_interfaces/srv/AddTwoInts_Response",
        ),
        ([["call received", 9]], "a report on a call that does not exist"),
        (
            [["goal", 9, "/fib", ACTS[6], "/talker", ID, TWIST, False]],
            "a goal of '/fib', of which '/talker' has no client",
        ),
        ([["goal", 9, "/fib", ACTS[6], "", ID, TWIST, False]], "a goal that no client has sent"),
        ([["goal", 9, "/fib", ACTS[6], "", "xyz", TWIST, False]], "an invalid goal id"),
        ([["goal", 9, "/fib", ACTS[6], "", "00", TWIST, False]], "an invalid goal id"),
        (
            [ACTS, ["goal", 9, "/fib", ACTS[6], "/talker", ID, TWIST, False], ["goal event", 9, "succeeded"]],
            "an invalid event of a goal",
        ),
        (
            [ACTS, ["goal", 9, "/fib", ACTS[6], "/talker", ID, TWIST, False], ["goal result", 9, TWIST]],
            "a report on a goal that its server has not taken",
        ),
        (
            [
                ACTS,
                ["goal", 9, "/fib", ACTS[6], "/talker", ID, TWIST, False],
                ["goal started", 9, "/talker"],
                ["goal started", 9, "/talker"],
            ],
            "a goal that another server has taken",
        ),
        (
            [
                ACTS,
                ["goal", 9, "/fib", ACTS[6], "/talker", ID, TWIST, False],
                ["goal started", 9, "/fibber"],
            ],
            "a report on the node '/fibber', which it does not have",
        ),
        ([["goal answered", 9]], "a report on a goal that does not exist"),
    ],
)  # fmt: skip
def test_an_invalid_event_ends_the_run(events, words):
    assert reason_for(answer_with(*events)) == sent(words)


@pytest.mark.parametrize(
    ("reports", "words"),
    [
        ({"logs": 5}, "logs that are not a list"),
        ({"logs": [["INFO", "talker"]]}, "logs that are not lists of 3"),
        ({"logs": [["LOUD", "talker", "hi"]]}, "a log line of unknown level"),
        ({"node_facts": [["/talker", "asleep"]]}, "an unknown fact of a node"),
        ({"logs": [["INFO", "talker", 5]]}, "a log line that is not a text"),
        ({"prints": [5]}, "a print that is not a text"),
        ({"nodes": [5]}, "a node's name that is not a text"),
        ({"errors": [["/a", "b", "c", "d", None]]}, "an error that is not a text"),
        ({"busy_loops": [["/a", 3]]}, "a busy loop that is not a text"),
        ({"unheard": [["/a", 3]]}, "a node's name that is not a text"),
        ({"parameters": [["/a", 3, True]]}, "a name that is not a text"),
        ({"timers": [["/a", -1, "b"]]}, "a timer's period that is not a number from 0 to 1e+09"),
        ({"timers": [["/a", True, "b"]]}, "a timer's period that is not a number from 0 to 1e+09"),
        ({"callbacks": [[0, 0, "/a", "b", "dance"]]}, "a callback of unknown kind"),
        ({"departures": [[0, "/a", "dance", "x", "2b71ed"]]}, "a departure of unknown kind"),
        ({"departures": [[0, "/a", "turn", "x", "2b71ed,"]]}, "a departure of unknown kind"),
        (
            {"callbacks": [[0.5, 0, "/a", "b", "timer"]]},
            "the beginning of a callback that is not a number from 0 to 0",
        ),
        (
            {"callbacks": [[0, 9, "/a", "b", "timer"]]},
            "a callback's duration that is not a number from 0 to 1e-09",
        ),
        ({"prints": [""] * 100_001}, "100001 prints at once; 100000 are allowed"),
    ],
)  # fmt: skip
def test_an_invalid_self_report_ends_the_run(reports, words):
    assert reason_for(self_reports(**reports)) == sent(words)


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (QUIET | {"events": None}, "events that are not a list"),
        (QUIET | {"next": 0}, "a next moment that is not an integer from 1 to 1000000000"),
        (QUIET | {"next": END + 1}, "a next moment that is not an integer from 1 to 1000000000"),
        (QUIET | {"next": None}, "a next moment that is not an integer from 1 to 1000000000"),
        (QUIET | {"blocked": 5}, "a reason that is not a text"),
        (QUIET | {"fault": ["goal", "well done"]}, "a fault of unknown kind"),
        (QUIET | {"fault": "hang"}, "a fault of unknown kind"),
        (QUIET | {"fault": ["hang", 5]}, "a reason that is not a text"),
    ],
)
def test_an_invalid_answer_ends_the_run(answer, words):
    assert reason_for(answer) == sent(words)


def test_a_run_that_ends_early_in_the_other_process_is_reported():
    assert reason_for(QUIET | {"next": END // 2}, {"done": True, "threads": False}) == (
        "The process with the nodes ended unexpectedly at 0.5 s: something in it ended the run there, "
        "or wrote to its connections."
    )


def test_the_next_time_step_must_be_later():
    assert reason_for(QUIET | {"next": END // 2}, QUIET | {"next": END // 4}) == sent(
        "a next moment that is not an integer from 500000001 to 1000000000"
    )


def test_a_process_that_stays_busy_reaches_the_time_limit():
    with answering(after=QUIET | {"busy": True}) as remote, pytest.raises(RemoteLost) as lost:
        remote.total = 0.0
        run(remote, seconds=1, quiet=True)
    assert lost.value.reason == "The process with the nodes took more than 0 s for one run."


def test_a_flood_of_messages_is_a_livelock():
    hello = ["message", "/talker", "/chat", encode(String(data="hello")), False]
    with answering(answer_with(TALKS, *[hello] * 20_001)) as remote:
        recording = run(remote, seconds=1, quiet=True)
    assert recording.ended.detail == ("/talker sent 20000 messages at t = 0 s without letting time advance.")


def test_long_texts_are_cut_and_surrogates_replaced():
    with answering(self_reports(logs=[["INFO", "a" * 999, "b" * 99_999], ["WARN", "x", "\ud800"]])) as remote:
        recording = run(remote, seconds=1, quiet=True)
    assert [(line.node, line.text) for line in recording.logs] == [("a" * 255, "b" * 20_000), ("x", "?")]


def test_a_process_that_could_not_run_the_nodes_says_why():
    assert reason_for({"failed": "TypeError: no"}) == "The nodes could not be run: TypeError: no."


def test_a_failure_is_reported_on_one_printable_line():
    assert reason_for({"failed": "a\x1b[2J\nb\u202e\ud800" + "c" * 9_999}) == (
        "The nodes could not be run: a?[2J b??" + "c" * 1_991 + "."
    )


def test_a_stderr_that_is_not_a_text_ends_the_run():
    assert reason_for(QUIET | {"alive": False}, over={"stderr": 5}) == sent("a stderr that is not a text")


def test_creating_and_destroying_endpoints_has_a_limit(monkeypatch):
    monkeypatch.setattr("sim.ros.remote.proxies.MAX_ENDPOINTS_PER_RUN", 50)
    again = [TALKS, ["destroyed", [1]]] * 50 + [TALKS]
    assert reason_for(answer_with(*again)) == sent(
        "more than 50 endpoints of topics, services and actions, one after the other"
    )


def test_all_events_of_a_run_have_a_limit(monkeypatch):
    monkeypatch.setattr("sim.ros.remote.events.MAX_EVENTS_PER_RUN", 2)
    hello = ["message", "/talker", "/chat", encode(String(data="hello")), False]
    assert reason_for(answer_with(TALKS, hello) | {"next": 1}, answer_with(hello)) == sent(
        "more than 2 events"
    )


def test_all_texts_of_a_run_have_a_limit(monkeypatch):
    monkeypatch.setattr("sim.ros.remote.validation.MAX_TOTAL_TEXT", 20)
    words = "more than 20 characters of log lines, names and other texts"
    assert reason_for(self_reports(logs=[["INFO", "talker", "hello"]] * 3)) == sent(words)
    assert reason_for(self_reports(prints=["x" * 21])) == sent(words)
    assert reason_for(self_reports(errors=[["/talker", "tick", "E", "no", "line 1"]] * 2)) == sent(words)


def test_events_that_take_too_long_to_apply_end_the_run():
    with answering(answer_with(TALKS), deadline=lambda: 0.0) as remote, pytest.raises(RemoteLost) as lost:
        run(remote, seconds=1, quiet=True)
    assert lost.value.reason == sent("more than can be processed in the remaining time")


@pytest.mark.parametrize("period", [2**64 - 1, math.inf, math.nan])
def test_a_number_out_of_range_is_refused(period):
    assert reason_for(self_reports(timers=[["/talker", period, "tick"]])) == sent(
        "a timer's period that is not a number from 0 to 1e+09"
    )


class Asker(Node):
    """Calls /add once, at 0.25 s."""

    def __init__(self):
        super().__init__("asker")
        self.client = self.create_client(AddTwoInts, "/add")
        self.timer = self.create_timer(0.25, self.ask)

    def ask(self):
        self.timer.cancel()
        self.client.call_async(AddTwoInts.Request(a=1, b=2))


def test_a_course_call_taken_by_two_servers_keeps_its_request_time():
    type_ = "example_interfaces/srv/AddTwoInts"
    again = ["call", 13, "/add", type_, "/asker", True, encode(AddTwoInts.Request(a=1, b=2)), False]
    half = QUIET | {"next": END // 2}
    with answering(half | {"events": [SERVES]}, half, answer_with(again)) as remote:
        made = run(Asker, remote, seconds=1, quiet=True).calls
    assert [(call.client, call.requested) for call in made] == [("/asker", 0.25)] * 2


def test_bytes_that_are_no_message_end_the_run():
    near, far = socket.socketpair()
    with near, far, pytest.raises(RemoteLost) as lost:
        far.sendall(b"\0\0\0\1\xc1")
        run(Remote(Wire(near)), seconds=1, quiet=True)
    assert (
        lost.value.reason
        == "The process with the nodes sent an invalid answer: the received bytes are no message."
    )


def test_a_connection_closed_before_the_run_is_reported():
    near, far = socket.socketpair()
    far.close()
    with near, pytest.raises(RemoteLost) as lost:
        run(Remote(Wire(near)), seconds=1, quiet=True)
    assert lost.value.reason == "The process with the nodes has ended."
