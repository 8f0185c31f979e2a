"""A run in two processes leaves the same recording as in one process."""

import importlib
from dataclasses import asdict

import pytest
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node

from sim import Recording, run
from sim.ros.fibers.scheduler import engine
from tests.sim.ros.remote import observers

ENGINE = "tests.students.engine"
ALONE = {
    "mains": (
        "classic", "with_finally", "own_executor", "two_nodes_one_executor", "spin_once_loop",
        "spin_once_polling", "busy_ok_loop", "shuts_itself_down", "raises_to_leave_spin", "init_again",
        "own_context", "only_a_node", "makes_one_with_init",
    ),
    "threads": (
        "spin_in_a_thread", "executor_in_a_thread", "thread_subclass", "thread_made_by_the_node",
        "lock_across_sleeps", "all_primitives", "queues", "pool", "two_groups_in_parallel",
    ),
    "errors": (
        "InTimer", "InSubscription", "InInit", "WithoutSuper", "InService", "InCoroutine", "InTask",
        "in_thread", "in_parallel_callback", "in_main", "chained", "init_twice", "without_init",
        "shutdown_twice", "publish_after_shutdown", "sys_exit", "os_exit", "asks_the_keyboard",
        "spins_nothing", "starts_a_run", "wrong_qos", "bad_topic_name", "needs_argument",
    ),
    "services": (
        "late_adder", "until_future_complete", "done_callback", "many_calls", "no_one_answers",
        "spin_in_a_callback", "parameter_services",
    ),
    "callers": (
        "two_servers", "asks_with_text", "calls_from_a_thread", "goes_away", "gives_up", "never_spins",
        "OwnCall",
    ),
    "actions": ("waiting_client", "blocking_client", "late_server"),
    "goals": ("two_servers", "sends_text", "asks_no_one", "sends_again"),
    "names": ("launches",),
    "topics": ("SaysItAtOnce", "SaysItAtOnceAndLatches"),
    "launched": ("twice",),
    "output": ("logs_at_every_level", "logs_debug_lines", "odd_texts"),
    "hangs": ("PingPong", "ZeroTimer", "EventNoOneSets", "JoinsItself", "GuardCondition"),
}  # fmt: skip
# The course's program in this process, the student's in the other one.
TOGETHER = [
    (("services", "Adder"), ("services", "Customer")),
    (("services", "Customer"), ("services", "Adder")),
    (("services", "Customer"), ("callers", "Raises")),
    (("services", "Customer"), ("callers", "ReturnsText")),
    (("services", "Adder"), ("callers", "AsksAtOnce")),
    (("callers", "AsksAtOnce"), ("services", "Adder")),
    (("actions", "Server"), ("goals", "AsksAtOnce")),
    (("goals", "AsksAtOnce"), ("actions", "Server")),
    (("callers", "Flood"), ("services", "SlowAdder")),
    (("services", "SlowAdder"), ("callers", "Flood")),
    (("callers", "Flood"), ("callers", "ShortMemory")),
    (("callers", "ShortMemory"), ("callers", "Flood")),
    (("services", "Customer"), ("callers", "DestroysItsService")),
    (("services", "Wheel"), ("services", "parameter_services")),
    (("actions", "Client"), ("actions", "Server")),
    (("actions", "Server"), ("actions", "Client")),
    (("actions", "Impatient"), ("actions", "Server")),
    (("actions", "Server"), ("actions", "Impatient")),
    (("actions", "Server"), ("actions", "Greedy")),
    (("actions", "Client"), ("actions", "Raising")),
    (("actions", "Client"), ("actions", "Coroutine")),
    (("actions", "Impatient"), ("goals", "IgnoresCancel")),
    (("goals", "CancelsTwice"), ("goals", "AlwaysRejectsCancel")),
    (("goals", "AlwaysRejectsCancel"), ("goals", "CancelsTwice")),
    (("actions", "Client"), ("goals", "JudgeRaises")),
    (("actions", "Client"), ("goals", "DestroysItsServer")),
    (("actions", "Client"), ("goals", "DestroysItsServerAsItJudges")),
    (("actions", "Impatient"), ("goals", "DestroysItsServerAsItCancels")),
    (("goals", "Later"), ("actions", "Client")),
    (("actions", "Server"), ("goals", "AsksForNoResult")),
]
# Messages that are sent before the two have discovered each other.
TOO_EARLY = [
    (("topics", "Receives"), ("topics", "SaysItAtOnce")),
    (("topics", "SaysItAtOnce"), ("topics", "Receives")),
]


OBSERVERS = "tests.sim.ros.remote.observers"
LOOKING = [
    ("Burst", "ShortListener"),
    ("ShortListener", "Burst"),
    ("LateTalker", "LateListener"),
    ("LateListener", "LateTalker"),
    ("PickyListener", "SloppyTalker"),
    ("SloppyTalker", "PickyListener"),
    ("Setter", "Gossip"),
    ("Gossip", "Setter"),
]
# The middleware, where it carries everything, counts a subscription before messages reach it.
COUNTING = [("Counter", "Counted"), ("Counted", "Counter")]


def found(module: str, name: str):
    return getattr(importlib.import_module(f"{ENGINE}.{module}"), name)


def evidence(recording: Recording) -> dict:
    """The whole recording, except the goals' random ids."""
    plain = asdict(recording) | {"seed": 0}
    for goal in plain["goals"]:
        goal["id"] = ""
    return plain


@pytest.mark.parametrize(("module", "name"), [(m, name) for m, names in ALONE.items() for name in names])
def test_a_program_in_the_other_process_leaves_an_equal_recording(follower, module, name):
    with follower.serving(f"{ENGINE}.{module}", name) as remote:
        there = run(remote, seconds=6, quiet=True)
    assert evidence(there) == evidence(run(found(module, name), seconds=6, quiet=True))


@pytest.mark.parametrize(("own", "other"), [*TOGETHER, *TOO_EARLY])
def test_two_programs_that_communicate_leave_an_equal_recording(follower, own, other):
    with follower.serving(f"{ENGINE}.{other[0]}", other[1]) as remote:
        there = run(found(*own), remote, seconds=8, quiet=True)
    assert evidence(there) == evidence(run(found(*own), found(*other), seconds=8, quiet=True))


@pytest.mark.parametrize(("own", "other"), [*LOOKING, *COUNTING])
def test_topics_with_all_kinds_of_qos_are_equal(follower, own, other):
    with follower.serving(OBSERVERS, other) as remote:
        there = run(getattr(observers, own), remote, seconds=5.5, quiet=True)
    here = run(getattr(observers, own), getattr(observers, other), seconds=5.5, quiet=True)
    assert evidence(there) == evidence(here)
    assert there.logs or there.messages("/answer")


def test_a_node_in_the_other_process_sees_the_same_graph(follower):
    own = found("services", "Adder"), found("actions", "Server"), observers.PickyListener
    with follower.serving(OBSERVERS, "Observer") as remote:
        there = run(*own, remote, world="room", seconds=2, quiet=True)
    here = run(*own, observers.Observer, world="room", seconds=2, quiet=True)
    assert [line.text for line in there.logs] == [line.text for line in here.logs]


def test_a_node_in_the_other_process_looks_the_same_in_the_graph(follower):
    with follower.serving(f"{ENGINE}.actions", "Server") as remote:
        there = run(observers.Observer, remote, seconds=2, quiet=True)
    here = run(observers.Observer, found("actions", "Server"), seconds=2, quiet=True)
    assert [line.text for line in there.logs] == [line.text for line in here.logs]


@pytest.mark.parametrize(
    "look",
    [
        lambda node: sorted(node.get_service_names_and_types()),
        lambda node: sorted(node.get_service_names_and_types_by_node("adder", "/")),
        lambda node: node.count_services("/add"),
        lambda node: node.create_client(AddTwoInts, "add").service_is_ready(),
        lambda node: node.create_client(SetParameters, "adder/set_parameters").service_is_ready(),
    ],
)
def test_proxies_of_services_are_created_when_a_node_looks_them_up(follower, look):
    made = []

    class Looker(Node):
        def __init__(self):
            super().__init__("looker", start_parameter_services=False)
            self.create_timer(0.5, self.look)

        def look(self):
            if link := engine().transport.peer:
                made.append(len(link.proxies.services))
            self.get_logger().info(f"{look(self)}")

    with follower.serving(f"{ENGINE}.services", "Adder") as remote:
        there = run(Looker, remote, seconds=0.7, quiet=True)
    here = run(Looker, found("services", "Adder"), seconds=0.7, quiet=True)
    assert made == [0]
    assert [line.text for line in there.logs] == [line.text for line in here.logs] != ["[]"]


@pytest.mark.parametrize("name", ["OtherService", "OtherClient", "LateOtherService", "NoName"])
def test_a_service_with_another_type_in_the_other_process_is_refused(follower, name):
    with follower.serving(OBSERVERS, name) as remote:
        there = run(found("services", "Adder"), remote, seconds=2, quiet=True)
    here = run(found("services", "Adder"), getattr(observers, name), seconds=2, quiet=True)
    assert evidence(there) == evidence(here)
    assert there.ended.reason == "error"


def test_several_nodes_of_a_student_run_in_one_process(follower):
    with follower.serving(f"{ENGINE}.callers", "First", "Second") as remote:
        there = run(found("services", "SlowAdder"), remote, seconds=8, quiet=True)
    names = [found("callers", name) for name in ("First", "Second")]
    assert evidence(there) == evidence(run(found("services", "SlowAdder"), *names, seconds=8, quiet=True))


def test_a_service_that_both_processes_offer_is_called_in_both(follower):
    with follower.serving(f"{ENGINE}.callers", "First", "OtherAdder") as remote:
        there = run(found("services", "SlowAdder"), remote, seconds=8, quiet=True)
    assert there.ended.reason == "time"
    assert {call.server for call in there.calls_of("/add")} == {"/adder"}


def test_an_action_that_both_processes_offer_gets_goals_in_both(follower):
    with follower.serving(f"{ENGINE}.actions", "Client", "Server") as remote:
        there = run(found("actions", "Server"), remote, seconds=8, quiet=True)
    assert there.ended.reason == "time"
    assert "succeeded" in {goal.status for goal in there.goals}


def test_a_drive_is_the_same_to_the_last_bit(follower):
    from tests.bench.avoider import main

    with follower.serving("tests.bench.avoider", "main") as remote:
        there = [run(remote, world="room", seconds=10, quiet=True) for _ in range(2)]
    assert [drive.digest for drive in there] == [run(main, world="room", seconds=10, quiet=True).digest] * 2


def in_any_order(recording: Recording) -> dict:
    """All but the list of departures, which has those of both processes one after the other."""
    return evidence(recording) | {"departures": []}


@pytest.mark.parametrize("order", ["1", "2", "any-4", "host-6"])
@pytest.mark.parametrize(
    ("module", "name"), [("threads", "two_groups_in_parallel"), ("mains", "two_nodes_one_executor")]
)
def test_another_order_leaves_an_equal_recording(follower, module, name, order):
    with follower.serving(f"{ENGINE}.{module}", name) as remote:
        there = run(remote, seconds=6, quiet=True, order=order)
    here = run(found(module, name), seconds=6, quiet=True, order=order)
    assert in_any_order(there) == in_any_order(here)
    assert there.digest == here.digest


@pytest.mark.parametrize("order", ["1", "2", "any-4", "host-6"])
@pytest.mark.parametrize(("own", "other"), [TOGETHER[1], TOGETHER[9], TOGETHER[14], *TOO_EARLY])
def test_two_programs_leave_an_equal_recording_in_another_order(follower, own, other, order):
    with follower.serving(f"{ENGINE}.{other[0]}", other[1]) as remote:
        there = run(remote, companions=[found(*own)], seconds=6, quiet=True, order=order)
    here = run(found(*other), companions=[found(*own)], seconds=6, quiet=True, order=order)
    assert in_any_order(there) == in_any_order(here)


@pytest.mark.soak
@pytest.mark.parametrize("order", [1, 2, 3, 5, 8, "any-4", "host-6"])
@pytest.mark.parametrize(("module", "name"), [(m, name) for m, names in ALONE.items() for name in names])
def test_a_program_in_the_other_process_is_equal_in_another_order(follower, module, name, order):
    with follower.serving(f"{ENGINE}.{module}", name) as remote:
        there = run(remote, seconds=6, quiet=True, order=order)
    assert in_any_order(there) == in_any_order(run(found(module, name), seconds=6, quiet=True, order=order))
