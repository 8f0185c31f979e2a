"""Exercises on clients: one that gets what it wants from a door, and one that must not freeze."""

from __future__ import annotations

import itertools

from grader.checks import Missed, check, publishes, rate, series
from grader.diagnosis.activity import slow_callback
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.services.calls import Call, accepted, calls, has_client, refused
from grader.exercises.services.servers import Door, SlowAdder, Wheels
from sim.recording import Recording

WAITING = (
    "While a callback or __init__ waits, nothing else of the node can run, and no answer comes in. "
    "Ask, return, and let the done callback do the rest."
)
OPEN, TRIGGER = "/door/open", "std_srvs/srv/Trigger"


@check(points=4)
def asks_the_door(recording: Recording) -> None:
    """The node asks /door/open (Trigger), although the door comes late."""
    has_client(recording, OPEN, TRIGGER)
    made = calls(recording, OPEN)
    heard = [call for call in made if call.taken is not None]
    lost = [call for call in made if call.lost]
    if lost or not heard:
        hint = (
            "A question to a service that isn't there yet is lost. Let a timer look once a second, and ask "
            "only when self.client.service_is_ready(), with brackets, is True."
        )
        saw = f"{len(lost)} asked too early, at {lost[0].asked:.3g} s" if lost else "no question"
        raise Missed("questions to the door, once it is there", saw, hint, credit=0.5 if heard else 0.0)
    if all(call.received is None for call in heard):
        saw = f"it asked at {heard[0].asked:.3g} s, and took no answer"
        raise Missed("a question, and the answer", saw, WAITING)


@check(points=3, after=asks_the_door)
def keeps_driving_commands(recording: Recording) -> None:
    """While it waits, the node goes on: a command on /cmd_vel comes 10 times a second."""
    _keeps_pace(recording, "/cmd_vel", WAITING)


@check(points=3, after=asks_the_door)
def warns_of_a_refusal(recording: Recording) -> None:
    """Each refusal is logged as a warning, with the door's message."""
    for call in _answered(recording, OPEN):
        lines = [
            line
            for line in recording.logs
            if 0 <= line.stamp - call.answered < 0.6 and call.response["message"] in line.text
        ]
        if refused(call) and not any(line.level == "WARN" for line in lines):
            saw = f"“{lines[0].text}” at level {lines[0].level}" if lines else "no line with it"
            hint = (
                "In the done callback: answer = future.result(). When answer.success is False: "
                "self.get_logger().warning(answer.message)."
            )
            expected = f"a warning with “{call.response['message']}” at {call.answered:.3g} s"
            with advising(recording, hint):
                raise Missed(expected, saw)


@check(points=3, after=asks_the_door)
def asks_until_yes(recording: Recording) -> None:
    """After a no it asks again, about once a second; after the yes it asks no more."""
    made = _answered(recording, OPEN)
    pauses = [after.asked - before.answered for before, after in itertools.pairwise(made)]
    if pauses and max(pauses) < 0.3:
        with advising(recording, "Only the timer asks, once a second: no loop, and not the done callback."):
            saw = f"{max(pauses):.2g} s" if max(pauses) >= 0 else "it asks again before the answer is there"
            raise Missed("a pause of about a second before it asks again", saw)
    yes = next((call for call in made if accepted(call)), None)
    if yes is None:
        hint = "Let a timer ask once a second, for as long as the answer is no."
        saw = f"{len(made)} in all, the last at {made[-1].asked:.3g} s, and it was refused"
        with advising(recording, hint):
            raise Missed("questions until the door says yes", saw)
    late = [call for call in made if call.asked > yes.answered]
    if late:
        with advising(recording, "When it is open: self.timer.cancel() stops the asking."):
            raise Missed("no question after the yes", f"{len(late)}, the first at {late[0].asked:.3g} s")


@check(points=3, after=asks_the_door)
def drives_through_the_open_door(recording: Recording) -> None:
    """It stands still until the door says yes, and then drives at 0.3 m/s."""
    yes = next((call for call in _answered(recording, OPEN) if accepted(call)), None)
    opened = yes.answered if yes else recording.ended.stamp
    commands = series(recording, "/cmd_vel", "linear.x")
    early = [(at, speed) for at, speed in commands if speed and at < opened]
    if early:
        saw = f"{early[0][1]:g} m/s at {early[0][0]:.3g} s, with the door closed"
        hint = "An answer is no yes yet: look at answer.success before you drive."
        raise Missed("linear.x 0 until the door is open", saw, hint)
    late = [(at, speed) for at, speed in commands if at > opened + 0.5 and abs(speed - 0.3) > 0.03]
    if late or not yes:
        saw = f"linear.x {late[0][1]:g} m/s at {late[0][0]:.3g} s" if late else "no yes from the door"
        with advising(recording, "In the done callback, when answer.success is True: self.speed = 0.3."):
            raise Missed("0.3 m/s from the yes on", saw)


def _answered(recording: Recording, service: str) -> list[Call]:
    return [call for call in calls(recording, service) if call.answered is not None]


door = Exercise(
    "door",
    "A visitor at the door",
    [
        asks_the_door,
        keeps_driving_commands,
        warns_of_a_refusal,
        asks_until_yes,
        drives_through_the_open_door,
    ],
    world="yard",
    seconds=14,
    companions=[Door],
    seeds=(1, 2),
)


ADD, ADD_TYPE = "/add_two_ints", "example_interfaces/srv/AddTwoInts"
TOTAL, HEART = "/ticks/total", "/heartbeat"
CURE = (
    "The answer arrives in a callback, too, and that can't run while look waits. Ask with call_async, and "
    "let a done callback publish the answer; or await it, with timer and client in a ReentrantCallbackGroup."
)
GROUPS = (
    "While look waits for an answer, or awaits it, nothing else of its callback group runs. Give its timer "
    "and the client a group of their own, a ReentrantCallbackGroup; or use a done callback."
)


@check(points=4)
def asks_every_second(recording: Recording) -> None:
    """Once a second the node asks /add_two_ints."""
    has_client(recording, ADD, ADD_TYPE)
    made = calls(recording, ADD)
    due = int(recording.seconds) - 1
    if len(made) < 0.8 * due:
        hint = "Let a timer with a period of 1 s call look, and ask there: self.client.call_async(request)."
        stuck = any(call.received is None for call in made)
        raise Missed(f"{due} questions in {recording.seconds:g} s", f"{len(made)}", CURE if stuck else hint)


@check(points=4, after=asks_every_second)
def publishes_the_totals(recording: Recording) -> None:
    """Each answer is published on /ticks/total (Int64), as soon as it is there."""
    with advising(recording, "self.publisher.publish(Int64(data=answer.sum)), once the answer is there."):
        heard = publishes(recording, TOTAL, "std_msgs/msg/Int64")
    for call in _answered(recording, ADD):
        sums = [h.message.data for h in heard if 0 <= h.stamp - call.answered < 0.2]
        if call.response["sum"] not in sums:
            saw = ", ".join(map(str, sums)) or "no message"
            hint = "Publish the sum of the answer itself, once it is there: answer.sum."
            expected = f"{call.response['sum']} on {TOTAL}, the answer of {call.answered:.3g} s"
            with advising(recording, hint):
                raise Missed(expected, f"{saw} in the 0.2 s after it")


@check(points=2, after=asks_every_second)
def asks_with_the_newest_ticks(recording: Recording) -> None:
    """It asks for the sum of the newest ticks of both wheels."""
    for call in calls(recording, ADD):
        newest = []
        for side in ("left", "right"):
            before = [value for at, value in series(recording, f"/ticks/{side}", "data") if at <= call.asked]
            newest.append(before[-2:])
        a, b = call.request["a"], call.request["b"]
        if not (a in newest[0] and b in newest[1]) and not (b in newest[0] and a in newest[1]):
            hint = "AddTwoInts.Request(a=self.left, b=self.right), made anew for each question."
            expected = f"a={newest[0][-1]}, b={newest[1][-1]}"
            raise Missed(expected, f"{call.question}", hint)


@check(points=4, after=asks_every_second)
def heart_goes_on(recording: Recording) -> None:
    """The heart beats on at 10 Hz, also while the node waits for an answer."""
    _keeps_pace(recording, HEART, GROUPS)


def _keeps_pace(recording: Recording, topic: str, hint: str) -> None:
    """Messages come at 10 Hz, without a pause; what holds them up is a callback that waits."""
    try:
        rate(recording, topic, 10.0)
    except Missed as missed:  # rate's own hint is for timers of another period
        hint = slow_callback(recording) or hint
        raise Missed(missed.expected, missed.saw, hint, picture=missed.picture) from None


ticks = Exercise(
    "ticks",
    "A node that freezes",
    [asks_every_second, publishes_the_totals, asks_with_the_newest_ticks, heart_goes_on],
    seconds=10,
    companions=[SlowAdder, Wheels],
    seeds=(1, 2),
)
