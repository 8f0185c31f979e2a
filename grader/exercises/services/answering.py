"""Exercises on servers: a first one that adds, and one that calibrates a gyro."""

from __future__ import annotations

import math
import re

from grader.checks import Missed, check, series
from grader.exercise import Exercise
from grader.exercises.services.calls import Call, accepted, asked, not_so, offers, refused
from grader.exercises.services.partners import READINGS, Pupil, RawGyro, Technician
from sim.recording import Recording

ADD, ADD_TYPE = "/add_two_ints", "example_interfaces/srv/AddTwoInts"


@check(points=4)
def offers_to_add(recording: Recording) -> None:
    """The node offers the service /add_two_ints of type AddTwoInts."""
    offers(recording, ADD, ADD_TYPE)


@check(points=4, after=offers_to_add)
def adds(recording: Recording) -> None:
    """Every question is answered with the sum of its two numbers."""
    for call in asked(recording, ADD):
        total = call.request["a"] + call.request["b"]
        if call.response.get("sum") != total:
            hint = "response.sum = request.a + request.b, and then return response."
            not_so(recording, f"sum={total} for {call.question}", call, hint)


add = Exercise(
    "add",
    "A service in one line",
    [offers_to_add, adds],
    seconds=6,
    companions=[Pupil],
    seeds=(1, 2),
)


CALIBRATE, TRIGGER = "/gyro/calibrate", "std_srvs/srv/Trigger"
RAW, RATE = "/gyro/raw", "/gyro/rate"
ENOUGH = f"It refused with {READINGS} readings. Refuse only below that: if len(self.readings) < {READINGS}."


@check(points=3)
def offers_to_calibrate(recording: Recording) -> None:
    """The node offers the service /gyro/calibrate of type Trigger."""
    offers(recording, CALIBRATE, TRIGGER)


@check(points=4, after=offers_to_calibrate)
def refuses_too_early(recording: Recording) -> None:
    """With fewer than 50 readings it refuses: success is False, and the message says why."""
    for call in asked(recording, CALIBRATE, at_least=2):
        count = len(_readings_before(recording, call))
        if count >= READINGS:
            continue
        expected = f"success=False and a message after {count} readings, for {call.question}"
        hint = (
            f"First of all look at len(self.readings). Below {READINGS}: response.success = False, "
            "response.message = ..., return response."
        )
        if not refused(call):
            not_so(recording, expected, call, hint)
        if not call.response["message"].strip():
            not_so(recording, expected, call, "Say in response.message why not.", credit=0.5)


@check(points=4, after=offers_to_calibrate)
def gyro_reads_zero(recording: Recording) -> None:
    """After a calibration /gyro/rate is 0 on average, with the robot at rest."""
    for call in _possible(recording):
        values = [value for at, value in series(recording, RATE, "data") if 0 < at - call.asked < 1.0]
        if not values:
            raise Missed(
                f"messages on {RATE} after {call.question}",
                "none",
                "In hear: publish the reading minus self.bias.",
                picture="topics",
            )
        mean = sum(values) / len(values)
        if abs(mean) > 0.01:
            raise Missed(
                f"a mean of 0 rad/s, within 0.01, in the second after {call.question}",
                f"{mean:.3g} rad/s",
                _bias_hint(recording, call, mean),
                picture="topics",
            )


@check(points=3, after=offers_to_calibrate)
def tells_the_bias(recording: Recording) -> None:
    """A calibration is answered with success, and its message names the bias it found."""
    for call in _possible(recording):
        bias = _bias(recording, call)
        expected = f"success=True and {bias:.3f} in the message, for {call.question}"
        if not accepted(call):
            hint = "response.success is False until you set it: response.success = True."
            if _did_nothing(recording, call):
                hint = ENOUGH
            not_so(recording, expected, call, hint)
        numbers = [float(number) for number in re.findall(r"-?\d+\.\d+", call.response["message"])]
        good = (bias, _used_bias(recording, call))
        if not any(abs(number - wanted) < 0.0015 for number in numbers for wanted in good):
            hint = 'An f-string fills it in: response.message = f"bias {self.bias:.3f} rad/s".'
            not_so(recording, expected, call, hint)


def _possible(recording: Recording) -> list[Call]:
    """The calls that came after enough readings."""
    made = asked(recording, CALIBRATE, at_least=4)
    return [call for call in made if len(_readings_before(recording, call)) >= READINGS]


def _readings_before(recording: Recording, call: Call) -> list[float]:
    return [value for at, value in series(recording, RAW, "data") if at <= call.asked]


def _bias(recording: Recording, call: Call) -> float:
    return sum(_readings_before(recording, call)[-READINGS:]) / READINGS


def _used_bias(recording: Recording, call: Call) -> float:
    """What the node takes away from its readings after a calibration; NaN where it publishes nothing."""
    means = []
    for topic in (RAW, RATE):
        values = [value for at, value in series(recording, topic, "data") if 0 < at - call.asked < 1.0]
        means.append(sum(values) / len(values) if values else math.nan)
    return means[0] - means[1]


def _did_nothing(recording: Recording, call: Call) -> bool:
    """Whether the readings come out after a calibration as they come in."""
    return refused(call) and abs(_used_bias(recording, call)) < 0.01


def _bias_hint(recording: Recording, call: Call, mean: float) -> str:
    bias = _bias(recording, call)
    if abs(mean - 2 * bias) < 0.02:
        return "The bias was added in place of taken away: publish the reading minus self.bias."
    if abs(mean - bias) < 0.02 and refused(call):
        return ENOUGH
    if abs(mean - bias) < 0.02:
        return "The readings come out as they came in: calibrate has to set self.bias, with self."
    if _possible(recording).index(call) > 0:
        return (
            "The first calibration was good, this later one is not: the gyro is warmer now. "
            f"Take the mean of the last {READINGS} readings, each time anew."
        )
    return f"self.bias is the mean of the readings: their sum / their number, {bias:.3f} rad/s here."


calibrate = Exercise(
    "calibrate",
    "A gyro that can be calibrated",
    [offers_to_calibrate, refuses_too_early, gyro_reads_zero, tells_the_bias],
    seconds=10,
    companions=[RawGyro, Technician],
    seeds=(1, 2),
)
