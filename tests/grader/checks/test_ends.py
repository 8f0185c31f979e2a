"""The ends of topics, services and actions that the student's nodes declare, or what there is in their place."""

import pytest

from grader import Missed
from grader.checks.ends import declared
from sim.evidence import Endpoint, Graph
from tests.sim.recordings import recording

PAIRS = (
    ("publisher", "subscription", "topic"),
    ("service", "client", "service"),
    ("action server", "action client", "action"),
)
OTHER = {kind: other for one, two, _ in PAIRS for kind, other in ((one, two), (two, one))}
FLOAT32, FLOAT64 = "std_msgs/msg/Float32", "std_msgs/msg/Float64"


def graph(*ends):
    """A run with ends, given as kind, name, type, and whether it is the course's."""
    return recording(graph=Graph([], [Endpoint(kind, "/node", name, type, {}, own) for kind, name, type, own in ends]))


def missed(*arguments):
    with pytest.raises(Missed) as caught:
        declared(*arguments, "it")
    assert caught.value.expected == "it"
    return caught.value


@pytest.mark.parametrize("kind", OTHER)
def test_the_students_ends_of_a_kind_a_name_and_a_type_are_found(kind):
    run = graph(
        (kind, "/a", FLOAT32, False),
        (kind, "/a", FLOAT32, True),
        (kind, "/b", FLOAT32, False),
        (OTHER[kind], "/a", FLOAT32, False),
    )
    for type in ("", FLOAT32):
        assert declared(run, kind, "/a", type, "it") == [run.graph.endpoints[0]]


@pytest.mark.parametrize(
    ("kind", "absent", "instead"),
    [
        ("publisher", "no publisher there", "there is one on /far"),
        ("subscription", "no subscription there", "there is one to /far"),
        ("service", "no server for it", "there is one for /far"),
        ("client", "no client for it", "there is one for /far"),
        ("action server", "no server for it", "there is one for /far"),
        ("action client", "no client for it", "there is one for /far"),
    ],
)
def test_where_there_is_none_the_others_of_its_kind_are_named(kind, absent, instead):
    miss = missed(graph(), kind, "/near", "")
    assert (miss.saw, miss.hint, miss.typo) == (absent, "", None)
    miss = missed(graph((kind, "/far", FLOAT32, False)), kind, "/near", "")
    assert (miss.saw, miss.hint, miss.typo) == (f"{absent}; {instead}", "", None)
    both = (kind, "/far", FLOAT32, False), (kind, "/away", FLOAT32, False), (kind, "/far", FLOAT32, False)
    assert missed(graph(*both), kind, "/near", "").saw == f"{absent}; {instead.replace('/far', '/away, /far')}"


@pytest.mark.parametrize("kind", OTHER)
def test_one_of_nearly_the_same_name_is_a_typo_unless_it_is_connected_or_of_the_course(kind):
    miss = missed(graph((kind, "/temperatur", FLOAT32, False)), kind, "/temperature", "")
    assert miss.hint == "Is /temperatur a typo? Did you mean /temperature?"
    assert miss.typo == ("/temperatur", "/temperature")
    connected = (kind, "/temperatur", FLOAT32, False), (OTHER[kind], "/temperatur", FLOAT32, True)
    assert missed(graph(*connected), kind, "/temperature", "").typo is None
    assert missed(graph((kind, "/temperatur", FLOAT32, True)), kind, "/temperature", "").typo is None


@pytest.mark.parametrize("topic", ["/rosout", "/parameter_events", "/clock"])
def test_topics_that_every_node_has_are_not_named(topic):
    assert missed(graph(("publisher", topic, FLOAT32, False)), "publisher", "/near", "").saw == "no publisher there"


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("publisher", "a topic must use the same message type: on"),
        ("subscription", "a topic must use the same message type: on"),
        ("service", "a service must use the same type: on"),
        ("client", "a service must use the same type: on"),
        ("action server", "an action must use the same type: on"),
        ("action client", "an action must use the same type: on"),
    ],
)
def test_one_of_another_type_is_named(kind, words):
    run = graph((kind, "/a", "pkg/msg/Right", False), (kind, "/a", "pkg/msg/Wrong", False))
    miss = missed(run, kind, "/a", "pkg/msg/Right")
    assert miss.saw == "type pkg/msg/Wrong on /a"
    assert miss.hint == f"Both ends of {words} /a it is pkg/msg/Right."
    assert miss.typo is None


@pytest.mark.parametrize(("found", "wanted"), [(FLOAT32, FLOAT64), (FLOAT64, FLOAT32)])
def test_one_float_for_the_other_is_a_typo_where_it_is_published(found, wanted):
    assert missed(graph(("publisher", "/a", found, False)), "publisher", "/a", wanted).typo == (found, wanted)
    assert missed(graph(("subscription", "/a", found, False)), "subscription", "/a", wanted).typo is None
    assert missed(graph(("publisher", "/a", "std_msgs/msg/Int32", False)), "publisher", "/a", wanted).typo is None
