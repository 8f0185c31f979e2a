"""A gyro that can be calibrated by a service."""

import math
from typing import NamedTuple

from grader.checks import Missed, course_calls, offers, series, usual_mistake, wrong_response
from grader.checks.services import call_text, is_refusal, is_success, sent_at
from grader.companions.service_clients import READINGS, Technician
from grader.companions.service_servers import RawGyro
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import Window, same, states
from sim.evidence import Call, Recording, Seconds

CALIBRATE, RAW, RATE = "/gyro/calibrate", "/gyro/raw", "/gyro/rate"
CLOSE, NEW = 0.001, 0.021  # rad/s, s
Signal = list[tuple[Seconds, float]]
ENOUGH = (f"It refused with {READINGS} readings. Refuse only if there are fewer: if len(self.readings) < "
          f"{READINGS}.")

calibrate = Exercise("calibrate", "A gyro that can be calibrated", seconds=10,
                     companions=[RawGyro, Technician], seeds=(1, 2))


@calibrate.check(3)
def offers_to_calibrate(run: Recording) -> None:
    """The node offers the service /gyro/calibrate of type Trigger."""
    offers(run, CALIBRATE, "std_srvs/srv/Trigger")


@calibrate.check(4, after=offers_to_calibrate)
def refuses_too_early(run: Recording) -> None:
    """With fewer than 50 readings it refuses: success is False, and the message gives the reason."""
    for call in course_calls(run, CALIBRATE, at_least=2):
        count = len(_readings_before(run, call))
        if count >= READINGS:
            continue
        expected = f"success=False and a message after {count} readings, for {call_text(call)}"
        if not is_refusal(call):
            guess = (f"Check len(self.readings) first. Below {READINGS}: response.success = False, "
                     "response.message = ..., return response.")
            raise wrong_response(expected, call, guess)
        if not call.response.message.strip():
            decides = any(map(is_success, course_calls(run, CALIBRATE)))  # an empty response is no refusal
            raise wrong_response(expected, call, "Give the reason in response.message.", credit=0.5 * decides)


@calibrate.check(4, after=offers_to_calibrate)
def gyro_reads_zero(run: Recording) -> None:
    """After a calibration /gyro/rate is 0 on average, with the robot at rest."""
    hint = "In the callback: publish the reading minus self.bias."
    for number, it in enumerate(_calibrations(run)):
        if math.isnan(it.rate):
            raise Missed(f"messages on {RATE} after {call_text(it.call)}", "none", hint, picture="topics")
        if it.unrelated is not None:
            expected = f"each reading of {RAW} minus the bias, after {call_text(it.call)}"
            raise Missed(expected, f"{it.unrelated:.3g} rad/s, which matches none of them", hint,
                         picture="topics")
        if not is_near(it.rate, 0.0, 0.01):
            expected = f"a mean of 0 rad/s, within 0.01, in the second after {call_text(it.call)}"
            saw = f"{it.rate:.3g} rad/s"
            raise Missed(expected, saw, _bias_hint(it, first=number == 0), picture="topics")


@calibrate.check(3, after=offers_to_calibrate)
def reports_the_bias(run: Recording) -> None:
    """A calibration responds with success, and the message gives the bias it found."""
    for it in _calibrations(run):
        expected = f"success=True and {it.bias:.3f} in the message, for {call_text(it.call)}"
        if not is_success(it.call):
            unchanged = is_refusal(it.call) and abs(it.used) < 0.01
            yes = "response.success is False until you set it: response.success = True."
            raise wrong_response(expected, it.call, ENOUGH if unchanged else yes)
        if not states(it.call.response.message, it.bias, it.used, tolerance=0.0015):
            guess = 'An f-string inserts the number: response.message = f"bias {self.bias:.3f} rad/s".'
            raise wrong_response(expected, it.call, guess)


class Calibration(NamedTuple):
    """A call after enough readings. In rad/s, each a mean: NaN without data."""

    call: Call
    bias: float  # of the last readings before the call
    rate: float  # of what the node publishes in the second after it
    used: float  # what the node takes away from the readings in that second
    unrelated: float | None  # a rate that is no reading minus that, where many are not


def _calibrations(run: Recording) -> list[Calibration]:
    found = []
    for call in course_calls(run, CALIBRATE, at_least=4):
        readings = _readings_before(run, call)
        if len(readings) >= READINGS:
            after = run.during(sent_at(call), sent_at(call) + 1.0)
            raw, rates = (series(after, topic, "data") for topic in (RAW, RATE))
            rate = _mean([value for _, value in rates])
            used = _mean([value for _, value in raw]) - rate
            wrong = _unrelated(raw, rates, used)
            found.append(Calibration(call, _mean(readings[-READINGS:]), rate, used, wrong))
    return found


def _unrelated(raw: Signal, rates: Signal, used: float) -> float | None:
    """The first rate that is no new reading minus what is used, where more than a quarter are not."""

    def follows(stamp: Seconds, rate: float) -> bool:
        new = Window(stamp - NEW, stamp)
        return any(new.contains(at) and same(reading - used, rate, CLOSE) for at, reading in raw)

    wrong = [rate for stamp, rate in rates if not follows(stamp, rate)]
    return wrong[0] if len(wrong) > len(rates) / 4 or len(rates) > 2 * len(raw) else None


def _readings_before(run: Recording, call: Call) -> list[float]:
    return [value for at, value in series(run, RAW, "data") if at <= sent_at(call)]


def _mean(values: list[float]) -> float:
    return sum(values) / len(values) if values else math.nan


def _bias_hint(it: Calibration, first: bool) -> str:
    unchanged = "The readings are published unchanged: calibrate has to set self.bias, with self."
    biases = {
        "The bias was added instead of subtracted: publish the reading minus self.bias.": 2 * it.bias,
        ENOUGH if is_refusal(it.call) else unchanged: it.bias,
    }
    otherwise = f"self.bias is the mean of the readings: sum(...) / len(...), {it.bias:.3f} rad/s here."
    if not first:
        otherwise = ("The first calibration was good, but this later one isn't: the gyro is warmer now. "
                     f"Compute a new mean each time, of the last {READINGS} readings.")
    return usual_mistake(biases, lambda bias: same(it.rate, bias, 0.02)) or otherwise
