"""A program of ROS 1, written again for ROS 2."""

import itertools
import math
from functools import partial

from grader.checks import Missed, answers, course_calls, named, otherwise, publishes, subscribes
from grader.checks.ends import declared
from grader.checks.fields import plain, stamp_words
from grader.checks.services import is_success, sent_at
from grader.companions.parameter_start import started_with
from grader.exercise import Exercise, Scenario
from grader.exercises.settings.port.engine_sensor import VOLTS, engine, engine_and_gain_setter
from grader.geometry.near import is_near
from grader.responses import from_course
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds, since_start

__all__ = ["engine", "port"]

TEMPERATURE, TYPE = "/engine/temperature", "sensor_msgs/msg/Temperature"
STARTED = 12.5  # degrees for a volt
SET = "/thermometer/set_parameters"
LATE = 0.06  # s after a message in which the one before it may still be used
NEAR, SETTLED = 1e-3, 0.45  # degrees; s until a new gain or the first volts show

port = Exercise("port", "A program from ROS 1", scenarios=[
    Scenario(seconds=10, seed=1, companions=engine, name="default"),
    Scenario(seconds=7, seed=2, companions=engine_and_gain_setter, name="gain",
             prepare=partial(started_with, "gain", STARTED))], variants=Variants(  # type: ignore[arg-type]  # the program comes first
    {"gain": (25, 20, 24), "hot": (80, 63, 75)},
    {"rate": (5, 4), "period": (0.2, 0.25), "often": ("five", "four")},
    {"frame": ("engine", "motor", "cylinder")},
    texts=('"~gain", {gain})', '"gain", {gain}.0)', "{gain} by default", "would `{gain}`",
           "> {hot}", "above {hot}", "Rate({rate})", "{rate} Hz", "publishes {rate} times",
           "temperatures {often}", "in seconds: {period}", "create_timer({period}, ",
           'frame_id = "{frame}"', "frame {frame}"),
))


@port.check(1)
def has_its_ends(run: Recording) -> None:
    """The node /thermometer subscribes to /engine/volts, and publishes Temperature on /engine/temperature."""
    named(run, "/thermometer")
    subscribes(run, VOLTS, "std_msgs/msg/Float64")
    declared(run, "publisher", TEMPERATURE, TYPE, f"a publisher of type {TYPE} on {TEMPERATURE}")


def _is_never_called(run: Recording, *about: Message) -> bool:
    """Return whether a loop keeps the student's callbacks from running, or from coming to their end."""
    return all(row.node in run.course_nodes for row in run.callbacks)


@port.check(2, after=has_its_ends, only="default", hints={
    "A loop keeps the executor from calling `receive`: rclpy runs one callback at a time, and none before "
    "`__init__` has returned. Make the body of the loop the callback of a timer.": _is_never_called,
    "That is from the volts before: store each message that arrives, and use the newest.":
        lambda run, row: any(_is_near(row, port.drawn.gain * sent.message.data)
                             for sent in from_course(run, VOLTS)),
    "The listing multiplies the last volts by the gain, which is 25 by default.": otherwise,
})
def publishes_temperatures(run: Recording) -> list[Message]:
    """Each temperature is the last volts times the gain, and there is none before the first volts."""
    rows = publishes(run, TEMPERATURE, TYPE)
    for row in rows:
        _require_product(run, row, port.drawn.gain)
    return rows


@port.check(1, after=publishes_temperatures, only="default", hints={
    "rospy.Rate(5) is 5 Hz, but create_timer takes the period, in seconds: 0.2.":
        lambda run, hz: hz < 1.0,
    "The loop of the listing doesn't wait for volts: it publishes the last ones again. Publish in the "
    "callback of a timer, not in `receive`.": otherwise,
})
def five_times_a_second(run: Recording, rows: list[Message]) -> None:
    """From the first volts to the end, it publishes 5 times a second, even when no volts arrive."""
    first = from_course(run, VOLTS)[0].stamp
    stamps = [first, *(row.stamp for row in rows), run.ended.stamp]
    hz = len(rows) / (run.ended.stamp - first)
    pause, since = max((later - stamp, stamp) for stamp, later in itertools.pairwise(stamps))
    due = port.drawn.rate
    if not 0.88 * due <= hz <= 1.12 * due or pause > SETTLED:
        saw = f"{hz:.3g} Hz, and none for {pause:.2g} s from {since:.3g} s on"
        raise Missed(f"{due} Hz from the first volts to the end", saw, about=(hz,), picture="topics")


@port.check(1, after=publishes_temperatures, only="default")
def is_stamped(run: Recording, rows: list[Message]) -> None:
    """The header has the time at which the message is published, and the frame engine."""
    for row in rows:
        header = row.message.header
        if not is_near(since_start(header.stamp), row.stamp, 0.02):
            hint = "rospy.Time.now() is self.get_clock().now().to_msg(), called again for each message."
            expected = f"the stamp {row.stamp:.3f} s in the message of that time"
            raise Missed(expected, stamp_words(header.stamp), hint)
        frame = port.drawn.frame
        if header.frame_id != frame:
            hint = f"As in the listing: header.frame_id is {frame}, without a slash."
            raise Missed(f"frame_id “{frame}”", f"“{header.frame_id}”" if header.frame_id else "none", hint)


@port.check(1, after=publishes_temperatures, only="default",
            guess="rospy.logwarn(...) is self.get_logger().warning(...), for each temperature above 80.")
def warns_above_80(run: Recording) -> None:
    """Each temperature above 80 degrees is logged as a warning, and no other."""
    hot = port.drawn.hot
    answers(run, TEMPERATURE, level="WARN", within=0.15, where=lambda row: row.message.temperature > hot,
            what=f"temperatures above {hot} degrees", only=True)


@port.check(2, after=has_its_ends, only="gain", hints={
    "A loop keeps the executor from running callbacks: see the check of the temperatures.": _is_never_called,
    "That is with the default gain. The node has a parameter that is called `gain`, without the `~`: "
    "self.declare_parameter(\"gain\", 25.0).": lambda run, row, gain: _is_one_of(run, row, port.drawn.gain),
    "That is with the gain from before. rospy.get_param in the loop asks each time, and so must "
    "self.get_parameter(\"gain\").value.":
        lambda run, row, gain: gain != STARTED and _is_one_of(run, row, STARTED),
    "First let the temperatures be right without a gain.": otherwise,
})
def follows_the_gain(run: Recording) -> None:
    """The gain is a parameter, 25 by default: any number at the start, and another one while it runs."""
    call = course_calls(run, SET)[0]
    gain = plain(call.request)["gain"]
    rows = publishes(run, TEMPERATURE, TYPE)
    for row in rows:
        if row.stamp < sent_at(call):
            _require_product(run, row, STARTED, STARTED)
    if not is_success(call):
        expected = f"the gain can be set to {gain:g} at {call.requested:.3g} s"
        hint = f"Declare `gain` with the default {port.drawn.gain}.0, and don't refuse any other value."
        raise Missed(expected, "no answer" if call.answered is None else "it is refused", hint)
    for row in publishes(run.during(sent_at(call) + SETTLED), TEMPERATURE, TYPE):
        _require_product(run, row, gain, gain)


def _require_product(run: Recording, row: Message, gain: float, *about: float) -> None:
    """Raise Missed for a temperature that is not the last volts times the gain."""
    first = from_course(run, VOLTS)[0].stamp
    if row.stamp < first:
        hint = "The listing has `if volts is not None`: until then it publishes nothing."
        expected = f"no temperature before the first volts, at {first:.3g} s"
        raise Missed(expected, f"{row.message.temperature:.4g} at {row.stamp:.3g} s", hint)
    if not any(_is_near(row, gain * volts) for volts in _last_volts(run, row.stamp)):
        expected = f"{gain * _last_volts(run, row.stamp)[-1]:.4g} degrees at {row.stamp:.3g} s"
        raise Missed(expected, f"{row.message.temperature:.4g}", about=(row, *about))


def _last_volts(run: Recording, stamp: Seconds) -> list[float]:
    """The last volts at a moment, and the ones before if these have just arrived."""
    sent = [row for row in from_course(run, VOLTS) if row.stamp <= stamp + 1e-6]
    return [row.message.data for row in sent[-2:] if row is sent[-1] or sent[-1].stamp > stamp - LATE]


def _is_near(row: Message, temperature: float) -> bool:
    return math.isclose(row.message.temperature, temperature, abs_tol=NEAR)


def _is_one_of(run: Recording, row: Message, gain: float) -> bool:
    return any(_is_near(row, gain * volts) for volts in _last_volts(run, row.stamp))
