"""The follower process: the commands that it executes."""

import socket
import threading

import pytest
from rclpy.node import Node

from sim import run
from sim.ros.remote import Remote, RemoteLost, Wire, WireBroken, WireClosed, serve
from tests.patience import PATIENCE


class Idle(Node):
    def __init__(self):
        super().__init__("idle")


@pytest.fixture
def wires():
    near, far = socket.socketpair()
    with near, far:
        yield Wire(near), Wire(far)


def test_the_last_message_is_what_serve_returns(wires):
    Remote(wires[0]).end(points=5, text="well done")
    assert serve(wires[1], [Idle]) == {"do": "end", "points": 5, "text": "well done"}


@pytest.mark.parametrize(
    ("order", "words"),
    [
        ({"do": "dance"}, "unknown command 'dance'"),
        ({"do": "call", "function": "why"}, "unknown function 'why'"),
        ({}, "unknown command None"),
    ],
)
def test_an_unknown_command_is_refused(wires, order, words):
    wires[0].send(**order)
    with pytest.raises(WireBroken, match=f"^{words}$"):
        serve(wires[1], [Idle])


def test_serving_ends_when_the_connection_is_closed(wires):
    wires[0].close()
    with pytest.raises(WireClosed):
        serve(wires[1], [Idle])


def kinds(nodes, ending):
    return [type(node).__name__ + ending for node in nodes]


def test_a_function_is_called_with_the_nodes(wires):
    wires[0].send(do="call", function=f"{__name__}:kinds", arguments=["?"])
    Remote(wires[0]).end()
    serve(wires[1], [None, 5, "Idle"])
    assert wires[0].receive(PATIENCE)["answer"] == ["NoneType?", "int?", "str?"]


def test_nodes_that_can_t_be_run_are_reported(wires):
    wires[0].send(do="run", seconds=1.0, seed=0, order="", preparation="")
    wires[0].send(do="go", now=0, events=[])
    Remote(wires[0]).end()
    assert serve(wires[1], [5]) == {"do": "end"}
    assert wires[0].receive(PATIENCE) == {
        "failed": "TypeError: grade() takes Node classes, functions that return a node, or main() functions;"
        " this is 5."
    }


def test_only_one_other_process_can_take_part(wires):
    def answer():
        far, quiet = wires[1], {"events": [], "self_reports": {}, "next": 10**9, "busy": False, "alive": True}
        for _ in range(2):
            far.receive()
        far.send(**quiet, fault=None, blocked="")
        far.receive()
        far.send(stderr="")

    thread = threading.Thread(target=answer)
    thread.start()
    with pytest.raises(RemoteLost) as lost:
        run(Remote(wires[0]), Remote(wires[0]), seconds=1, quiet=True)
    thread.join()
    assert lost.value.reason == "Only one other process can have nodes in a run."


def test_one_turn_per_time_step_is_enough_without_events(follower, monkeypatch):
    """Parallel callbacks take several rounds, which cause no events for the leader."""
    moments, send = [], follower.wire.send

    def count(**message):
        moments.extend([message["now"]] if message.get("do") == "go" else [])
        send(**message)

    monkeypatch.setattr(follower.wire, "send", count)
    with follower.serving("tests.students.engine.threads", "two_groups_in_parallel") as remote:
        recording = run(remote, seconds=3, quiet=True)
    assert len(recording.logs) == 8
    assert len(moments) == len(set(moments)) == 9


def as_it_is(node):
    """A preparation that changes nothing."""
    return node


def test_what_is_prepared_may_take_four_times_as_long(follower, monkeypatch):
    patiences, receive = [], follower.wire.receive

    def note(timeout=None):
        patiences.append(timeout)
        return receive(timeout)

    monkeypatch.setattr(follower.wire, "receive", note)
    node = "tests.students.engine.threads", "two_groups_in_parallel"
    with follower.serving(*node, patience=PATIENCE) as remote:
        for preparation in ([], ["tests.sim.ros.remote.test_serving:as_it_is"]):
            del patiences[:]
            run(remote.program(preparation), seconds=1, quiet=True)
            assert patiences[0] == (4 if preparation else 1) * PATIENCE
            assert set(patiences[1:]) == {PATIENCE}


def test_a_process_that_does_not_receive_is_given_up(wires):
    remote = Remote(Wire(wires[0]._socket, patience=0.05))
    with pytest.raises(RemoteLost) as lost:
        remote.end(text="x" * 5_000_000)
    assert lost.value.reason == "The process with the nodes gave no answer for 30 s."
