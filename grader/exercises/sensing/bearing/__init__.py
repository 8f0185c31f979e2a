"""The bearing of a red post, from the images of a camera."""

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.ends import declared
from grader.checks.fields import stamp_words
from grader.exercise import Exercise, Scenario
from grader.exercises.sensing.bearing.camera import Format, camera
from grader.exercises.sensing.bearing.image import bearing_of, column_of_red, is_red, pixels_of
from grader.geometry.near import is_near
from grader.responses import Stimuli, Stimulus
from grader.variants import Variants
from sim.evidence import Recording
from sim.network import Network

__all__ = ["Format", "bearing", "camera"]

IMAGE, BEARING = "sensor_msgs/msg/Image", "geometry_msgs/msg/Vector3Stamped"
NEAR = 0.04  # rad
RADIO = Network(delay=0.04, jitter=0.02)  # from the robot, which has the camera, to the laptop
BRIGHT = 90, 100, 120, 128, 150, 180, 200  # from which on a value is called bright
EXPLAINED = 0.25  # of the points, where one mistake explains all bearings
FRAME = "camera_link"
COPY = f'Copy the stamp: answer.header.stamp = image.header.stamp; and frame_id is "{FRAME}".'
IS_OPTICAL = ("That is the optical frame, whose z axis points ahead: a turn about it is a roll. The bearing "
              "is a turn about the z axis of camera_link, which points up.")
PLAIN, PADDED, BGR = Format(), Format(width=86, padding=6), Format("bgr8", 72)


def _seen_by(layout: Format, name: str, seconds: float, seed: int) -> Scenario:
    """A run with a camera that stores its images in this way."""
    companions = functools.partial(camera, layout=layout)
    return Scenario(name=name, seconds=seconds, seed=seed, network=RADIO, companions=companions)


bearing = Exercise("bearing", "The bearing of a red post", scenarios=[
    _seen_by(PLAIN, "rgb8", 6.0, 1), _seen_by(PADDED, "padded", 4.0, 2), _seen_by(BGR, "bgr8", 4.0, 3),
], variants=Variants({"topic": ("/bearing", "/post/bearing", "/direction")}, texts=("{topic}",)))


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
        """Return whether there is one bearing of a post, and none without a post."""
        if self.true is None:
            return not self.values
        return len(self.values) == 1 and abs(self.values[0] - self.true) <= NEAR

    def missed(self, wrong: list["View"]) -> Missed:
        """Return what to raise for it. wrong: all that are wrong."""
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
    topic = bearing.drawn.topic
    declared(run, "publisher", topic, BEARING, f"a publisher of type {BEARING} on {topic}")


def _is_brighter(least: int, red: np.ndarray, *others: np.ndarray) -> np.ndarray:
    return red > least


def _median_of(count: Callable[..., np.ndarray]) -> Callable[[np.ndarray, float, int], float]:
    """The bearing of the middle of what a node counts as red, which is given the three colors."""

    def formula(pixels: np.ndarray, true: float, width: int) -> float:
        columns = np.nonzero(count(*(pixels[..., channel] for channel in range(3))))[1]
        return bearing_of(float(np.median(columns)) + 0.5, width)

    return formula


def _mean_of_all(pixels: np.ndarray, true: float, width: int) -> float:
    return bearing_of(float(np.nonzero(is_red(pixels))[1].mean()) + 0.5, width)


def _tallest_column(pixels: np.ndarray, true: float, width: int) -> float:
    return bearing_of(float(np.argmax(is_red(pixels).sum(axis=0))) + 0.5, width)


# Mistakes after which the rest can still be judged: the bearing that a node publishes then, of the pixels,
# the true bearing and the width of an image.
MISTAKES = {
    "Left is positive: a column in the left half of the image has a bearing above 0.":
        lambda pixels, true, width: -true,
    "That is in degrees. math.atan gives radians, and so does ROS.":
        lambda pixels, true, width: math.degrees(true),
    "Pixels aren't angles: halfway to the edge is not half of 45 degrees. Take math.atan(1 - 2 * column / "
    "width).": lambda pixels, true, width: math.tan(true) * math.pi / 4,
    "That is the tangent of the bearing: math.atan(...) makes an angle of it.":
        lambda pixels, true, width: math.tan(true),
    "Single red pixels pull the mean to their side. Take np.median(columns).": _mean_of_all,
    "That is the column with the most red pixels, which may be anywhere in the post. Take the middle of the "
    "post, np.median(columns).": _tallest_column,
    "Something else counts as red. The numbers are uint8, and 2 * green wraps at 256: convert with "
    ".astype(int) first.":
        _median_of(lambda red, green, blue: (red > 90) & (2 * green < red) & (2 * blue < red)),
    "Something else counts as red: compare red with green and with blue.":
        _median_of(lambda red, green, blue: (red > 90) & (2 * green.astype(int) < red)),
    "Something else is bright, too: red is where green and blue are less than half of it.":
        tuple(_median_of(functools.partial(_is_brighter, least)) for least in BRIGHT),
}
ANOTHER_WIDTH = ("That is the bearing in an image of {width} columns. This one has fewer or more: take "
                 "image.width.")


def _mistake(wrong: list[View]) -> str:
    """Return what explains all wrong bearings, as a hint; "" if nothing does."""
    for hint, formulas in MISTAKES.items():
        for formula in formulas if isinstance(formulas, tuple) else (formulas,):
            found = [(view.values, formula(pixels_of(view.image.value), view.true, view.image.value.width))
                     for view in wrong if view.true is not None]
            if all(values for values, _ in found) and all(
                    abs(value - expected) <= NEAR / 4 for values, expected in found for value in values):
                return hint
    width = _other_width(wrong)
    return ANOTHER_WIDTH.format(width=width) if width else ""


def _other_width(wrong: list[View]) -> int:
    """The one width with which all wrong bearings would be right; 0 if there is none."""
    found = [(view, value) for view in wrong for value in view.values if view.true is not None]
    widths = [2 * column / (1 - math.tan(value)) for view, value in found
              if math.isfinite(value) and not is_near(math.tan(value), 1.0, 1e-6)
              and (column := column_of_red(pixels_of(view.image.value)))]
    return round(widths[0]) if len(widths) > 1 and 0 < max(widths) < 1.02 * min(widths) else 0


@bearing.check(3, after=has_its_endpoints, only="rgb8", hints={
    "A node that publishes more than once for an image repeats old news: publish in the image's callback, "
    "once.": lambda run, wrong: any(len(view.values) > 1 for view in wrong),
    "A bearing is a finite number. Is there a division by 0, or a mean of no columns?":
        lambda run, wrong: any(not math.isfinite(value) for view in wrong for value in view.values),
    "Something else counts as red, or not all of the post does: its red is over 90, and green and blue are "
    "less than half of that.": lambda run, wrong: any(view.values for view in wrong),
    "Publish a bearing for every image with 20 or more red pixels.": otherwise,
})
def finds_the_post(run: Recording) -> None:
    """Each image with a red post gets one message, with the post's bearing in vector.z."""
    wrong = [view for view in _posts(run) if not view.right]
    if wrong:
        missed = wrong[0].missed(wrong)
        if all(len(view.values) == 1 for view in wrong) and (mistake := _mistake(wrong)):
            missed.hint, missed.credit = mistake, EXPLAINED
        raise missed


@bearing.check(1, after=has_its_endpoints, only="rgb8", hints={
    "nan is a value like any other: return before publish(...) if there is no post.":
        lambda run, wrong: any(math.isnan(value) for value in wrong[0].values),
    "Publish a bearing for each image that shows a post, and for no other one.":
        lambda run, wrong: wrong[0].true is not None,
    "Up to 10 single pixels are red by mistake: publish only if 20 or more are.": otherwise,
})
def is_silent_without_a_post(run: Recording) -> None:
    """An image without a red post gets no message, and most of those with one get some."""
    views = _views(run)
    wrong = [view for view in views if view.true is None and view.values]
    unanswered = [view for view in views if view.true is not None and not view.values]
    wrong += unanswered if 2 * len(unanswered) > len(views) else []
    if wrong:
        raise wrong[0].missed(wrong)


@bearing.check(1, after=(has_its_endpoints, finds_the_post), only="rgb8")
def stamps_and_frames(run: Recording) -> None:
    """Each message has the image's stamp, and the frame camera_link, in its header."""
    for view in (view for view in _posts(run) if view.values):
        image, answer = view.image.value.header, view.image.responses[0].message.header
        if answer.stamp != image.stamp:
            expected = f"the stamp {stamp_words(image.stamp)} of the image in the message on it"
            hint = f"That is the time of the answer. {COPY}" if answer.stamp.sec else COPY
            raise Missed(expected, stamp_words(answer.stamp), hint)
        if answer.frame_id != FRAME:
            hint = IS_OPTICAL if answer.frame_id == image.frame_id else COPY
            raise Missed(f"frame_id “{FRAME}”", f"“{answer.frame_id}”", hint, credit=0.5)


@bearing.check(1, after=(has_its_endpoints, finds_the_post), only="padded", hints={
    "If your node is right with the first camera, the reason is padding: each row ends with bytes that "
    "belong to no pixel. Reshape to (image.height, image.step), and cut them off with "
    "[:, : 3 * image.width].": otherwise,
})
def cuts_the_padding(run: Recording) -> None:
    """The same holds if rows have padding, so that step is more than three times the width."""
    _require_as_before(_posts(run))


@bearing.check(1, after=(has_its_endpoints, finds_the_post), only="bgr8", hints={
    "If your node is right with the first camera, the reason is the encoding: in bgr8 blue comes first. Read "
    "image.encoding, and reverse the colors with pixels[..., ::-1].": otherwise,
})
def reads_the_encoding(run: Recording) -> None:
    """The same holds if the encoding is bgr8."""
    _require_as_before(_posts(run))


def _views(run: Recording) -> list[View]:
    """Each image that had time for an answer. Raises as `publishes` if there is no answer at all."""
    topic = bearing.drawn.topic
    publishes(run, topic, BEARING)
    images = Stimuli("/image", answered_on=topic, within=0.2, what="images")
    pixels = [(image, pixels_of(image.value)) for image in images(run, at_least=5)]
    columns = [(image, column_of_red(seen)) for image, seen in pixels]
    return [View(image, None if column is None else bearing_of(column, image.value.width))
            for image, column in columns]


def _posts(run: Recording) -> list[View]:
    return [view for view in _views(run) if view.true is not None]


def _require_as_before(views: list[View]) -> None:
    """Raise Missed for the first wrong answer, unless a mistake explains them all: that has cost its part."""
    wrong = [view for view in views if not view.right]
    if wrong and not _mistake(wrong):
        raise wrong[0].missed(wrong)
