"""Connections that don't come about, and the reason that is given."""

import pytest
from rclpy.qos import QoSProfile, ReliabilityPolicy

from sim import run
from sim.evidence import Endpoint, Graph
from sim.evidence.connections import missing
from tests.sim.graphs import ALIVE, EARLY, LATE, LEASE, node

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
ON = "On /news /a publishes {}, and /b requests {}: nothing arrives."


def reasons(*nodes):
    return [gap.reason for gap in missing(run(*nodes, seconds=0.5, quiet=True).graph)]


@pytest.mark.parametrize(
    ("given", "wanted", "reason"),
    [
        (BEST_EFFORT, 10, ON.format("with reliability best_effort", "reliable")),
        (LATE, EARLY, ON.format("with deadline 0.5 s", "0.1 s")),
        (10, EARLY, ON.format("without a deadline", "0.1 s")),
        (10, ALIVE, ON.format("with liveliness automatic", "manual_by_topic")),
        (10, LEASE, ON.format("without a liveliness lease", "1 s")),
    ],
)
def test_settings_that_do_not_fit(given, wanted, reason):
    assert reasons(node("a", [("news", given)]), node("b", [], [("news", wanted)])) == [reason]


@pytest.mark.parametrize(("given", "wanted"), [(EARLY, LATE), (10, BEST_EFFORT), (ALIVE, 10), (LEASE, LEASE)])
def test_a_publisher_may_offer_more_than_is_asked_for(given, wanted):
    assert reasons(node("a", [("news", given)]), node("b", [], [("news", wanted)])) == []


@pytest.mark.parametrize(
    ("gives", "takes", "reason"),
    [
        ({}, {"takes": ["news"]}, "/b receives nothing: no node publishes on /news."),
        (
            {"gives": ["newz"]},
            {"takes": ["news"]},
            "/b receives nothing: no node publishes on /news, but /a publishes on /newz. Is /newz a typo? "
            "Did you mean /news?",
        ),
        (
            {"offers": ["Stop"]},
            {"asks": ["stop"]},
            "/b gets no response: no node offers the service /stop, but /a offers /Stop. "
            "Capital letters count: write /stop.",
        ),
        ({}, {"wants": ["drive"]}, "/b gets no response: no node offers the action /drive."),
    ],
)
def test_someone_waits_for_what_no_one_gives(gives, takes, reason):
    assert reasons(node("a", **gives), node("b", **takes)) == [reason]


def test_of_a_command_and_a_node_the_command_is_wrong():
    ends = [
        Endpoint("service", "/watchman", "/watchman/patrol", "std_srvs/srv/SetBool", {}),
        Endpoint("client", "/_ros2cli", "/patrol", "std_srvs/srv/SetBool", {}),
    ]
    (gap,) = missing(Graph(["/watchman", "/_ros2cli"], ends))
    assert gap.reason == (
        "/_ros2cli gets no response: no node offers the service /patrol, but /watchman offers "
        "/watchman/patrol. Only the namespace differs: write /watchman/patrol. A name that starts with a "
        "slash is taken as it is; without the slash the node's namespace is put before it."
    )


def test_another_type():
    ends = [
        Endpoint("publisher", "/a", "/news", "std_msgs/msg/String", {}),
        Endpoint("subscription", "/b", "/news", "std_msgs/msg/Int32", {}),
    ]
    (gap,) = missing(Graph(["/a", "/b"], ends))
    types = "/news has type std_msgs/msg/String in /a and std_msgs/msg/Int32 in /b"
    assert gap.reason == f"{types}: nothing arrives."


def test_a_graph_in_which_all_is_well_has_no_gap():
    giver = node("a", ["news"], offers=["stop"], does=["go"])
    assert reasons(giver, node("b", [], ["news"], asks=["stop"])) == []
