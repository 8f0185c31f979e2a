"""The picture of a graph: what is in it, that it can be read, and that it says the same in words."""

import itertools

import pytest
from matplotlib.colors import to_hex
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from rclpy.qos import QoSProfile, ReliabilityPolicy

from sim import Recording, run
from sim.view import plot_graph, png
from sim.view.figure import WARNING
from sim.view.wiring import wiring
from tests.bench.avoider import Avoider
from tests.sim.graphs import DELIVERY, node
from tests.sim.ros2.nodes import Lamp

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
WORDS = """\
topic /bumper (20 Hz): /robot -> nobody
topic /cmd_vel (10 Hz): /avoider -> /robot
topic /joint_states (20 Hz): /robot -> nobody
topic /odom (20 Hz): /robot -> /avoider
topic /scan (20 Hz): /robot -> /avoider
topic /tf (20 Hz): /robot -> nobody"""


@pytest.fixture(scope="module")
def delivery():
    return plot_graph(run(*DELIVERY, world="room", seconds=2, quiet=True))


def texts(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def red(figure):
    arrows = [patch for patch in figure.axes[0].patches if isinstance(patch, FancyArrowPatch)]
    return [arrow for arrow in arrows if to_hex(arrow.get_edgecolor()) == WARNING]


def test_it_shows_nodes_topics_and_rates_and_says_the_same_in_words():
    figure = plot_graph(run(Avoider, world="room", seconds=3, quiet=True))
    assert figure.words == WORDS
    drawn = {"/avoider", "/robot", "/scan", "20 Hz", "/cmd_vel", "10 Hz", "/bumper  20 Hz"}
    assert drawn <= set(texts(figure))
    assert red(figure) == []
    assert figure._repr_png_() == (png(figure), {"alt": WORDS})


def test_what_does_not_connect_is_red_broken_and_numbered_with_its_reason_below(delivery):
    assert len(red(delivery)) == 6  # a slip has two: to the name that was meant, and to the node that waits
    assert all(arrow.get_linestyle() != "-" for arrow in red(delivery))
    shown = texts(delivery)
    for number in "12345":
        assert number in shown
        assert any(text.startswith(f"{number}  ") for text in shown)
    assert "1  On /image /camera publishes with reliability best_effort, and" in " ".join(shown)
    assert delivery.words.endswith("\n5. /mission waits in vain: nobody offers the action /drive_too.")


def test_fifteen_nodes_fit_on_a_page_and_no_box_lies_on_another(delivery):
    width, height = delivery.get_size_inches()
    assert width < 10
    assert height < 14
    patches = [patch for patch in delivery.axes[0].patches if isinstance(patch, FancyBboxPatch)]
    boxes = [patch.get_window_extent() for patch in patches]
    assert len(boxes) > 30
    assert not [pair for pair in itertools.combinations(boxes, 2) if pair[0].overlaps(pair[1])]
    assert all(delivery.bbox.x0 <= box.x0 and box.x1 <= delivery.bbox.x1 for box in boxes)


def test_a_connection_that_fails_with_one_of_two_publishers_is_red_at_that_one():
    nodes = [node("a", ["news"]), node("b", [("news", BEST_EFFORT)]), node("c", [], ["news"])]
    shown = wiring(run(*nodes, seconds=1, quiet=True))
    news = "topic", "/news"
    assert [tuple(arrow) for arrow in shown.arrows.values()] == [
        (("node", "/a"), news, 0),
        (("node", "/b"), news, 1),
        (news, ("node", "/c"), 0),
    ]


def test_a_node_alone_and_a_run_without_nodes_have_a_picture_too():
    alone = plot_graph(run(Lamp, seconds=1, quiet=True))
    assert texts(alone) == ["/lamp"]  # what every node with a lifecycle offers is left out
    assert plot_graph(Recording()).words == ""


def test_equal_graphs_give_equal_pictures():
    pictures = [png(plot_graph(run(*DELIVERY[:5], seconds=1, quiet=True))) for _ in range(2)]
    assert pictures[0] == pictures[1]
