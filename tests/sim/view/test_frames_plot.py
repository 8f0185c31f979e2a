"""The picture of a tree of frames: what is in it, what is no tree, and that it says the same in words."""

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from sim import run
from sim.view import plot_frames, png
from tests.sim.view.test_graph_plot import red, texts


def broadcaster(*pairs, moving=()):
    """A node that publishes frames, each a parent and a child."""

    class Telling(Node):
        def __init__(self):
            super().__init__("telling")
            self.static, self.moving = StaticTransformBroadcaster(self), TransformBroadcaster(self)
            if pairs:
                self.static.sendTransform([transform(*pair) for pair in pairs])
            if moving:
                self.create_timer(
                    0.1, lambda: self.moving.sendTransform([transform(*pair) for pair in moving])
                )

    return Telling


def transform(parent, child):
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id, sent.transform.rotation.w = parent, 1.0
    return sent


def drawn(*nodes, **options):
    return plot_frames(run(*nodes, seconds=1, quiet=True, **options))


def test_it_shows_each_frame_in_its_parent_with_the_publisher():
    figure = drawn(broadcaster(("base_link", "camera"), moving=[("map", "odom")]), world="yard")
    assert figure.description == (
        "base_scan in base_link: static, /robot\n"
        "camera in base_link: static, /telling\n"
        "base_link in odom: 20 Hz, /robot\n"
        "odom in map: 10 Hz, /telling"
    )
    assert {"map", "odom", "10 Hz, /telling", "camera", "static, /telling"} <= set(texts(figure))
    assert red(figure) == []
    assert figure._repr_png_() == (png(figure), {"alt": figure.description})


def test_two_trees_are_reported():
    figure = drawn(broadcaster(("map", "dock"), ("sea", "island")))
    reason = "There are 2 trees, and no path connects map and sea."
    assert figure.description.endswith(f"Missing:\n1. {reason}")
    shown = [(text.get_text(), text.get_fontweight()) for text in figure.axes[0].texts]
    assert (reason, "normal") in shown  # without a number, which no arrow has


def test_a_frame_with_two_parents_is_red():
    other = broadcaster(moving=[("map", "laser"), ("map", "base_link")])
    figure = drawn(broadcaster(("base_link", "laser")), other)
    reason = "laser has two parents, base_link and map: that is not a tree."
    assert figure.description.endswith(f"Missing:\n1. {reason}")
    assert len(red(figure)) == 2


def test_a_run_without_frames_says_so():
    figure = drawn(broadcaster())
    assert (figure.description, texts(figure)) == ("No node published a frame.", ["no frames"])
