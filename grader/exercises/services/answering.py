"""Exercises on servers: a first one that adds, and one that calibrates a gyro."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from grader.checks import Missed, series, usual_mistake
from grader.checks.services import question
from grader.exercise import Exercise
from grader.exercises.services.calls import accepted, answer, offers, our_calls, refused, wrong_answer
from grader.exercises.services.partners import READINGS, Questioner, RawGyro, Technician
from sim.evidence import Call, Recording, Seconds

ADD = "/add_two_ints"

add = Exercise(
    "add", "A service in one line", seconds=6, companions=[Questioner], seeds=(1, 2), names_count=True
)


@add.check(4)
def offers_to_add(run: Recording) -> None:
    """The node offers the service /add_two_ints of type AddTwoInts."""
    offers(run, ADD, "example_interfaces/srv/AddTwoInts")


@add.check(4, after=offers_to_add, guess="response.sum = request.a + request.b, and then return response.")
def adds(run: Recording) -> None:
    """Every question is answered with the sum of its two numbers."""
    for call in our_calls(run, ADD):
        total = call.request.a + call.request.b
        if answer(call).get("sum") != total:
            raise wrong_answer(f"sum={total} for {question(call)}", call)


CALIBRATE, RAW, RATE = "/gyro/calibrate", "/gyro/raw", "/gyro/rate"
CLOSE, NEW = 0.001, 0.021  # rad/s, s
Signal = list[tuple[Seconds, float]]
ENOUGH = f"It refused with {READINGS} readings. Refuse only below that: if len(self.readings) < {READINGS}."

calibrate = Exercise(
    "calibrate",
    "A gyro that can be calibrated",
    seconds=10,
    companions=[RawGyro, Technician],
    seeds=(1, 2),
)


@calibrate.check(3)
def offers_to_calibrate(run: Recording) -> None:
    """The node offers the service /gyro/calibrate of type Trigger."""
    offers(run, CALIBRATE, "std_srvs/srv/Trigger")


@calibrate.check(4, after=offers_to_calibrate)
def refuses_too_early(run: Recording) -> None:
    """With fewer than 50 readings it refuses: success is False, and the message says why."""
    for call in our_calls(run, CALIBRATE, at_least=2):
        count = len(_readings_before(run, call))
        if count >= READINGS:
            continue
        expected = f"success=False and a message after {count} readings, for {question(call)}"
        if not refused(call):
            guess = (
                f"First of all look at len(self.readings). Below {READINGS}: response.success = False, "
                "response.message = ..., return response."
            )
            raise wrong_answer(expected, call, guess)
        if not call.response.message.strip():
            decides = any(map(accepted, our_calls(run, CALIBRATE)))  # an empty response is no refusal
            raise wrong_answer(expected, call, "Say in response.message why not.", credit=0.5 * decides)


@calibrate.check(4, after=offers_to_calibrate)
def gyro_reads_zero(run: Recording) -> None:
    """After a calibration /gyro/rate is 0 on average, with the robot at rest."""
    hint = "In hear: publish the reading minus self.bias."
    for number, it in enumerate(_calibrations(run)):
        if math.isnan(it.rate):
            raise Missed(f"messages on {RATE} after {question(it.call)}", "none", hint, picture="topics")
        if it.strange is not None:
            expected = f"each reading of {RAW} minus the bias, after {question(it.call)}"
            raise Missed(expected, f"{it.strange:.3g} rad/s, which is none of them", hint, picture="topics")
        if abs(it.rate) > 0.01:
            raise Missed(
                f"a mean of 0 rad/s, within 0.01, in the second after {question(it.call)}",
                f"{it.rate:.3g} rad/s",
                _bias_hint(it, first=number == 0),
                picture="topics",
            )


@calibrate.check(3, after=offers_to_calibrate)
def tells_the_bias(run: Recording) -> None:
    """A calibration is answered with success, and its message names the bias it found."""
    for it in _calibrations(run):
        expected = f"success=True and {it.bias:.3f} in the message, for {question(it.call)}"
        if not accepted(it.call):
            unchanged = refused(it.call) and abs(it.used) < 0.01
            yes = "response.success is False until you set it: response.success = True."
            raise wrong_answer(expected, it.call, ENOUGH if unchanged else yes)
        numbers = [float(number) for number in re.findall(r"-?\d+\.\d+", it.call.response.message)]
        if not any(abs(number - good) < 0.0015 for number in numbers for good in (it.bias, it.used)):
            guess = 'An f-string fills it in: response.message = f"bias {self.bias:.3f} rad/s".'
            raise wrong_answer(expected, it.call, guess)


class _Calibration(NamedTuple):
    """A call that came after enough readings. In rad/s, each a mean: NaN where there is nothing."""

    call: Call
    bias: float  # of the last readings before the call
    rate: float  # of what the node publishes in the second after it
    used: float  # what the node takes away from the readings in that second
    strange: float | None  # a rate that is no reading minus that, where many are none


def _calibrations(run: Recording) -> list[_Calibration]:
    found = []
    for call in our_calls(run, CALIBRATE, at_least=4):
        readings = _readings_before(run, call)
        if len(readings) >= READINGS:
            after = run.during(call.requested, call.requested + 1.0)
            raw, rates = (series(after, topic, "data") for topic in (RAW, RATE))
            rate = _mean([value for _, value in rates])
            used = _mean([value for _, value in raw]) - rate
            strange = _strange(raw, rates, used)
            found.append(_Calibration(call, _mean(readings[-READINGS:]), rate, used, strange))
    return found


def _strange(raw: Signal, rates: Signal, used: float) -> float | None:
    """The first rate that is no new reading minus what is used, where more than a quarter are none."""
    strange = [
        rate
        for at, rate in rates
        if not any(abs(it - used - rate) < CLOSE for when, it in raw if at - NEW <= when <= at + 1e-6)
    ]
    return strange[0] if len(strange) > len(rates) / 4 or len(rates) > 2 * len(raw) else None


def _readings_before(run: Recording, call: Call) -> list[float]:
    return [value for at, value in series(run, RAW, "data") if at <= call.requested]


def _mean(values: list[float]) -> float:
    return sum(values) / len(values) if values else math.nan


def _bias_hint(it: _Calibration, first: bool) -> str:
    unchanged = "The readings come out as they came in: calibrate has to set self.bias, with self."
    biases = {
        "The bias was added instead of subtracted: publish the reading minus self.bias.": 2 * it.bias,
        ENOUGH if refused(it.call) else unchanged: it.bias,
    }
    otherwise = f"self.bias is the mean of the readings: their sum / their number, {it.bias:.3f} rad/s here."
    if not first:
        otherwise = (
            "The first calibration was good, this later one is not: the gyro is warmer now. "
            f"Take the mean of the last {READINGS} readings, each time anew."
        )
    return usual_mistake(biases, lambda bias: abs(it.rate - bias) < 0.02) or otherwise
