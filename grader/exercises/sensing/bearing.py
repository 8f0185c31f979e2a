"""The bearing of a red post, from the images of a camera."""

import functools
import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.ends import declared
from grader.checks.fields import stamp_words
from grader.companions.camera import Format, camera
from grader.exercise import Exercise, Scenario
from grader.geometry.image import bearing_of, column_of_red, is_red, pixels_of
from grader.geometry.near import is_near
from grader.responses import Stimuli, Stimulus
from sim.evidence import Recording
from sim.network import Network

IMAGE, BEARING = "sensor_msgs/msg/Image", "geometry_msgs/msg/Vector3Stamped"
NEAR = 0.04  # rad
RADIO = Network(delay=0.04, jitter=0.02)  # from the robot, which has the camera, to the laptop
COPY = "Copy the header: answer.header = image.header."
PLAIN, PADDED, BGR = Format(), Format(width=86, padding=6), Format("bgr8", 72)


def _seen_by(layout: Format, name: str, seconds: float, seed: int) -> Scenario:
    """A run with a camera that stores its images in this way."""
    companions = functools.partial(camera, layout=layout)
    return Scenario(name=name, seconds=seconds, seed=seed, network=RADIO, companions=companions)


bearing = Exercise("bearing", "The bearing of a red post", scenarios=[
    _seen_by(PLAIN, "rgb8", 6.0, 1), _seen_by(PADDED, "padded", 4.0, 2), _seen_by(BGR, "bgr8", 4.0, 3)])
images = Stimuli("/image", answered_on="/bearing", within=0.2, what="images")


class View(NamedTuple):
    """An image, the bearing (rad) of the red post in it, or None, and what was published for it."""

    image: Stimulus
    true: float | None

    @property
    def values(self) -> list[float]:
        """The published bearings, in rad."""
        return [answer.message.vector.z for answer in self.image.responses]

    @property
    def right(self) -> bool:
        """Whether there is one bearing of a post, and none without a post."""
        if self.true is None:
            return not self.values
        return len(self.values) == 1 and abs(self.values[0] - self.true) <= NEAR

    def missed(self, wrong: list["View"]) -> Missed:
        """What to raise for it. wrong: all that are wrong."""
        text = " and ".join(f"{value:.2f} rad" for value in self.values) or "nothing"
        expected = "nothing" if self.true is None else f"one message with {self.true:.2f} rad"
        where = f"for the image at {self.image.stamp:.3g} s"
        reason = "" if self.true is not None else ", which shows no red post"
        return Missed(f"{expected} {where}{reason}", text, about=(wrong,))


@bearing.check(1, guess="In __init__, subscribe to /image with qos_profile_sensor_data, and "
                        "create a publisher for /bearing.")
def has_its_endpoints(run: Recording) -> None:
    """The node subscribes to /image, and publishes Vector3Stamped messages on /bearing."""
    subscribes(run, "/image", IMAGE)
    declared(run, "publisher", "/bearing", BEARING, f"a publisher of type {BEARING} on /bearing")


def _all_are(formula: Callable[[np.ndarray, float, int], float]) -> Callable[..., bool]:
    """The cause of a miss: all wrong bearings are what a formula makes of the image.

    It is given the pixels, and the bearing and width of the image.
    """

    def explains(run: Recording, wrong: list[View]) -> bool:
        found = [(view.values, formula(pixels_of(view.image.value), view.true, view.image.value.width))
                 for view in wrong if view.true is not None]
        return any(values for values, _ in found) and all(
            abs(value - expected) <= NEAR / 4 for values, expected in found for value in values)

    return explains


def _of_another_width(run: Recording, wrong: list[View]) -> Mapping[str, int] | None:
    """The one width with which all wrong bearings would be right, if there is one."""
    found = [(view, value) for view in wrong for value in view.values if view.true is not None]
    widths = [2 * column_of_red(pixels_of(view.image.value)) / (1 - math.tan(value)) for view, value in found
              if math.isfinite(value) and not is_near(math.tan(value), 1.0, 1e-6)]
    if len(widths) < 2 or not 0 < max(widths) < 1.02 * min(widths):
        return None
    return {"width": round(widths[0])}


def _mean_of_all(pixels: np.ndarray, true: float, width: int) -> float:
    return bearing_of(float(np.nonzero(is_red(pixels))[1].mean()) + 0.5, width)


@bearing.check(3, after=has_its_endpoints, only="rgb8", hints={
    "A node that publishes more than once for an image repeats old news: publish in the image's callback, "
    "once.": lambda run, wrong: any(len(view.values) > 1 for view in wrong),
    "A bearing is a finite number. Is there a division by 0, or a mean of no columns?":
        lambda run, wrong: any(not math.isfinite(value) for view in wrong for value in view.values),
    "Left is positive: a column in the left half of the image has a bearing above 0.":
        _all_are(lambda pixels, true, width: -true),
    "That is the bearing in an image of {width} columns. This one has fewer or more: take image.width.":
        _of_another_width,
    "That is in degrees. math.atan gives radians, and so does ROS.":
        _all_are(lambda pixels, true, width: math.degrees(true)),
    "Pixels aren't angles: halfway to the edge is not half of 45 degrees. Take math.atan(1 - 2 * column / "
    "width).": _all_are(lambda pixels, true, width: math.tan(true) * math.pi / 4),
    "That is the tangent of the bearing: math.atan(...) makes an angle of it.":
        _all_are(lambda pixels, true, width: math.tan(true)),
    "Single red pixels pull the mean to their side. Take np.median(columns).": _all_are(_mean_of_all),
    "Something else counts as red. The numbers are uint8, and 2 * green wraps at 256: convert with "
    ".astype(int) first, and compare red with both green and blue.":
        lambda run, wrong: any(view.values for view in wrong),
    "Publish a bearing for every image with 20 or more red pixels.": otherwise,
})
def finds_the_post(run: Recording) -> list[View]:
    """Each image with a red post gets one message, with the post's bearing in vector.z."""
    seen = _posts(run)
    _require_right(seen)
    return seen


@bearing.check(1, after=finds_the_post, only="rgb8", hints={
    "nan is a value like any other: return before publish(...) if there is no post.":
        lambda run, wrong: any(map(math.isnan, wrong[0].values)),
    "Up to 10 single pixels are red by mistake: publish only if 20 or more are.": otherwise,
})
def is_silent_without_a_post(run: Recording) -> None:
    """An image without a red post gets no message."""
    _require_right([view for view in _views(run) if view.true is None])


@bearing.check(1, after=finds_the_post, only="rgb8")
def copies_the_header(run: Recording, seen: list[View]) -> None:
    """Each message has the image's stamp and frame in its header."""
    for view in seen:
        image, answer = view.image.value.header, view.image.responses[0].message.header
        expected = f"the stamp {stamp_words(image.stamp)} of the image in the message on it"
        hint = "That is the time of the answer. Copy the header: answer.header = image.header."
        if answer.stamp != image.stamp:
            raise Missed(expected, stamp_words(answer.stamp), hint if answer.stamp.sec else COPY)
        if answer.frame_id != image.frame_id:
            saw = f"“{answer.frame_id}”" if answer.frame_id else "no frame"
            raise Missed(f"frame_id “{image.frame_id}”, as in the image", saw, COPY)


@bearing.check(1, after=(has_its_endpoints, finds_the_post), only="padded", hints={
    "If your node is right with the first camera, the reason is padding: each row ends with bytes that "
    "belong to no pixel. Reshape to (image.height, image.step), and cut them off with "
    "[:, : 3 * image.width].": otherwise,
})
def cuts_the_padding(run: Recording) -> None:
    """The same holds if rows have padding, so that step is more than three times the width."""
    _require_right(_posts(run))


@bearing.check(1, after=(has_its_endpoints, finds_the_post), only="bgr8", hints={
    "If your node is right with the first camera, the reason is the encoding: in bgr8 blue comes first. Read "
    "image.encoding, and reverse the colors with pixels[..., ::-1].": otherwise,
})
def reads_the_encoding(run: Recording) -> None:
    """The same holds if the encoding is bgr8."""
    _require_right(_posts(run))


def _views(run: Recording) -> list[View]:
    """Each image that had time for an answer. Raises as `publishes` if there is no answer at all."""
    publishes(run, "/bearing", BEARING)
    pixels = [(image, pixels_of(image.value)) for image in images(run, at_least=5)]
    columns = [(image, column_of_red(seen)) for image, seen in pixels]
    return [View(image, None if column is None else bearing_of(column, image.value.width))
            for image, column in columns]


def _posts(run: Recording) -> list[View]:
    return [view for view in _views(run) if view.true is not None]


def _require_right(views: list[View]) -> None:
    """Raise Missed for the first wrong answer."""
    wrong = [view for view in views if not view.right]
    if wrong:
        raise wrong[0].missed(wrong)
