"""The picture of a graph: what is in it, that it can be read, and that it says the same in words."""

import itertools

import pytest
from matplotlib.colors import to_hex
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from rclpy.qos import QoSProfile, ReliabilityPolicy

from sim import Recording, run
from sim.evidence import Endpoint
from sim.view import plot_graph, png
from sim.view.graph_data import graph_data
from sim.view.graph_diagram import graph_diagram
from sim.view.plot import WARNING
from tests.bench.avoider import Avoider
from tests.sim.graphs import DELIVERY, node
from tests.sim.ros2.nodes import Lamp

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
WORDS = """\
topic /bumper (20 Hz): /robot -> no node
topic /cmd_vel (10 Hz): /avoider -> /robot
topic /joint_states (20 Hz): /robot -> no node
topic /odom (20 Hz): /robot -> /avoider
topic /scan (20 Hz): /robot -> /avoider
topic /tf (20 Hz): /robot -> no node
topic /tf_static (1 message): /robot -> no node"""


@pytest.fixture(scope="module")
def delivery():
    return plot_graph(run(*DELIVERY, world="room", seconds=2, quiet=True))


def texts(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def red(figure):
    arrows = [patch for patch in figure.axes[0].patches if isinstance(patch, FancyArrowPatch)]
    return [arrow for arrow in arrows if to_hex(arrow.get_edgecolor()) == WARNING]


def test_it_shows_nodes_topics_and_rates_and_describes_them():
    figure = plot_graph(run(Avoider, world="room", seconds=3, quiet=True))
    assert figure.description == WORDS
    drawn = {"/avoider", "/robot", "/scan", "20 Hz", "/cmd_vel", "10 Hz", "/bumper  20 Hz"}
    assert drawn <= set(texts(figure))
    assert red(figure) == []
    assert figure._repr_png_() == (png(figure), {"alt": WORDS})


def test_what_does_not_connect_is_red_broken_and_numbered_with_its_reason_below(delivery):
    assert len(red(delivery)) == 6  # a typo has two: to the name that was meant, and to the node that waits
    assert all(arrow.get_linestyle() != "-" for arrow in red(delivery))
    shown = texts(delivery)
    for number in "12345":
        assert number in shown
        assert any(text.startswith(f"{number}  ") for text in shown)
    assert "1  On /image /camera publishes with reliability best_effort, and" in " ".join(shown)
    reason = "/mission gets no response: no node offers the action /drive_too."
    assert delivery.description.endswith(f"\n5. {reason}")


def test_fifteen_nodes_fit_on_a_page_and_no_boxes_overlap(delivery):
    width, height = delivery.get_size_inches()
    assert width < 10.5
    assert height < 14
    patches = [patch for patch in delivery.axes[0].patches if isinstance(patch, FancyBboxPatch)]
    boxes = [patch.get_window_extent() for patch in patches]
    assert len(boxes) > 30
    assert not [pair for pair in itertools.combinations(boxes, 2) if pair[0].overlaps(pair[1])]
    assert all(delivery.bbox.x0 <= box.x0 and box.x1 <= delivery.bbox.x1 for box in boxes)


def test_a_connection_that_fails_with_one_of_two_publishers_is_red_at_that_one():
    nodes = [node("a", ["news"]), node("b", [("news", BEST_EFFORT)]), node("c", [], ["news"])]
    shown = graph_diagram(run(*nodes, seconds=1, quiet=True))
    news = "topic", "/news"
    assert [tuple(arrow) for arrow in shown.arrows.values()] == [
        (("node", "/a"), news, 0),
        (("node", "/b"), news, 1),
        (news, ("node", "/c"), 0),
    ]


def test_a_node_alone_and_a_run_without_nodes_have_a_picture_too():
    alone = plot_graph(run(Lamp, seconds=1, quiet=True))
    assert texts(alone) == ["/lamp"]  # what every node with a lifecycle offers is left out
    assert plot_graph(Recording()).description == ""


def test_equal_graphs_give_equal_pictures():
    pictures = [png(plot_graph(run(*DELIVERY[:5], seconds=1, quiet=True))) for _ in range(2)]
    assert pictures[0] == pictures[1]


def recorded(*ends):
    """A recording of a graph: its ends are given by kind, node and name."""
    recording = Recording()
    for kind, at, name in ends:
        recording.graph.nodes.append(at)
        recording.graph.endpoints.append(Endpoint(kind, at, name, "std_msgs/msg/String", {}))
    return recording


def test_of_a_very_large_graph_what_is_missing_comes_first_and_the_rest_is_counted():
    given = [("publisher", "/talker", f"/topic{number}") for number in range(500)]
    taken = [("subscription", f"/listener{number}", "/topic0") for number in range(50)]
    figure = plot_graph(recorded(*given, *taken, ("subscription", "/lonely", "/target")))
    assert "/lonely" in texts(figure) and len(red(figure)) == 1
    omitted = "Not shown: 20 nodes, 461 topics, services and actions."
    reason = "/lonely receives nothing: no node publishes on /target."
    assert figure.description.endswith(f"\nMissing:\n1. {reason}\n{omitted}")
    assert omitted in texts(figure)
    assert "and 27 more" in texts(figure)
    assert max(figure.get_size_inches()) < 30


def test_many_missing_connections_are_counted_too():
    targets = [("subscription", "/lonely", f"/target{number}") for number in range(20)]
    figure = plot_graph(recorded(*targets))
    assert len(red(figure)) == 12
    assert figure.description.endswith("Not shown: 8 missing connections.")


def test_names_that_are_long_or_look_like_a_formula_are_drawn_as_they_are():
    long = "/a" + 100 * "b" + "c"
    figure = plot_graph(recorded(("publisher", long, "/cost$x^$"), ("subscription", "/shop", "/cost$x^$")))
    assert {"/a" + 20 * "b" + "…" + 21 * "b" + "c", "/cost$x^$"} <= set(texts(figure))
    assert png(figure)
    assert f"{long} -> /shop" in figure.description


def test_a_page_gets_the_same_in_whole_pixels():
    recording = recorded(("publisher", "/a", "/news"), ("subscription", "/b", "/newz"))
    data = graph_data(recording)
    assert data["words"] == plot_graph(recording).description
    assert data["reasons"] == [
        "/b receives nothing: no node publishes on /newz, but /a publishes on /news. Is /news a typo? "
        "Did you mean /newz?"
    ]
    kinds = [(box["kind"], *box["lines"]) for box in data["boxes"]]
    assert kinds == [
        ("node", "/a"), ("node", "/b"), ("topic", "/news", "0 messages"), ("topic", "/newz", "0 messages"),
    ]  # fmt: skip
    assert [arrow["gap"] for arrow in data["arrows"]] == [0, 1, 1]
    for x, y, width, height in (box["place"] for box in data["boxes"]):
        assert 0 <= x < x + width <= data["width"] and 0 <= y < y + height <= data["height"]
    assert all(type(value) is int for arrow in data["arrows"] for value in arrow["points"])
    assert graph_data(Recording()) is None


def test_a_page_that_writes_the_rates_itself_gets_an_empty_line_for_each():
    recording = recorded(("publisher", "/a", "/news"), ("subscription", "/b", "/news"))
    data = graph_data(recording, counted=False)
    assert [box["lines"] for box in data["boxes"]] == [["/a"], ["/b"], ["/news", ""]]
    assert data["words"] == "topic /news: /a -> /b"
