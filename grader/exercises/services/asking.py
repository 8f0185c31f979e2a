"""Exercises on clients: one that gets what it wants from a door, and one that must not freeze."""

from __future__ import annotations

import itertools

from grader.checks import Missed, hinting, publishes, rate, series
from grader.checks.services import question
from grader.diagnosis.activity import slow_callback
from grader.exercise import Exercise
from grader.exercises.services.calls import accepted, has_client, refused
from grader.exercises.services.servers import Door, SlowAdder, Wheels
from sim.evidence import Call, Recording

WAITING = (
    "While a callback or __init__ waits, nothing else of the node can run, and no answer comes in. "
    "Ask, return, and let the done callback do the rest."
)
OPEN = "/door/open"

door = Exercise(
    "door",
    "A visitor at the door",
    world="yard",
    seconds=14,
    companions=[Door],
    seeds=(1, 2),
)


@door.check(4)
def asks_the_door(run: Recording) -> list[Call]:
    """The node asks /door/open (Trigger), although the door comes late."""
    made = has_client(run, OPEN, "std_srvs/srv/Trigger")
    heard = [call for call in made if call.taken is not None]
    lost = [call for call in made if call.lost]
    answered = [call for call in made if call.answered is not None]
    if lost or not heard:
        hint = (
            "A question to a service that isn't there yet is lost. Let a timer look once a second, and ask "
            "only when self.client.service_is_ready(), with brackets, is True."
        )
        saw = f"{len(lost)} asked too early, at {lost[0].requested:.3g} s" if lost else "no question"
        credit = 0.5 if heard else 0.0
        raise Missed("questions to the door, once it is there", saw, hint, credit=credit, measured=answered)
    if all(call.received is None for call in heard):
        saw = f"it asked at {heard[0].requested:.3g} s, and took no answer"
        raise Missed("a question, and the answer", saw, WAITING)
    return answered


@door.check(3, after=asks_the_door)
def keeps_driving_commands(run: Recording) -> None:
    """While it waits, the node goes on: a command on /cmd_vel comes 10 times a second."""
    _keeps_pace(run, "/cmd_vel", WAITING)


@door.check(
    3,
    after=asks_the_door,
    guess="In the done callback: answer = future.result(). When answer.success is False: "
    "self.get_logger().warning(answer.message).",
)
def warns_of_a_refusal(run: Recording, answered: list[Call]) -> None:
    """Each refusal is logged as a warning, with the door's message."""
    for call in filter(refused, answered):
        message = call.response.message
        soon = run.during(call.answered, call.answered + 0.6).logs
        lines = [line for line in soon if message in line.text]
        if not any(line.level == "WARN" for line in lines):
            saw = f"“{lines[0].text}” at level {lines[0].level}" if lines else "no line with it"
            raise Missed(f"a warning with “{message}” at {call.answered:.3g} s", saw)


@door.check(3, after=asks_the_door)
def asks_until_yes(run: Recording, answered: list[Call]) -> None:
    """After a no it asks again, about once a second; after the yes it asks no more."""
    pauses = [after.requested - before.answered for before, after in itertools.pairwise(answered)]
    if pauses and max(pauses) < 0.3:
        saw = f"{max(pauses):.2g} s" if max(pauses) >= 0 else "it asks again before the answer is there"
        guess = "Only the timer asks, once a second: no loop, and not the done callback."
        raise Missed("a pause of about a second before it asks again", saw, guess=guess)
    yes = _yes(answered)
    if yes is None:
        saw = f"{len(answered)} in all, the last at {answered[-1].requested:.3g} s, and it was refused"
        guess = "Let a timer ask once a second, for as long as the answer is no."
        raise Missed("questions until the door says yes", saw, guess=guess)
    late = [call for call in answered if call.requested > yes.answered]
    if late:
        saw = f"{len(late)}, the first at {late[0].requested:.3g} s"
        guess = "When it is open: self.timer.cancel() stops the asking."
        raise Missed("no question after the yes", saw, guess=guess)


@door.check(3, after=asks_the_door)
def drives_through_the_open_door(run: Recording, answered: list[Call]) -> None:
    """It stands still until the door says yes, and then drives at 0.3 m/s."""
    yes = _yes(answered)
    opened = yes.answered if yes else run.ended.stamp
    commands = series(run, "/cmd_vel", "linear.x")
    early = [(at, speed) for at, speed in commands if speed and at < opened]
    if early:
        saw = f"{early[0][1]:g} m/s at {early[0][0]:.3g} s, with the door closed"
        hint = "Not every answer is a yes: look at answer.success before you drive."
        raise Missed("linear.x 0 until the door is open", saw, hint, unsafe=True)
    late = [(at, speed) for at, speed in commands if at > opened + 0.5 and abs(speed - 0.3) > 0.03]
    if late or not yes:
        saw = f"linear.x {late[0][1]:g} m/s at {late[0][0]:.3g} s" if late else "no yes from the door"
        guess = "In the done callback, when answer.success is True: self.speed = 0.3."
        raise Missed("0.3 m/s from the yes on", saw, guess=guess)


def _yes(calls: list[Call]) -> Call | None:
    return next(filter(accepted, calls), None)


def _keeps_pace(run: Recording, topic: str, hint: str) -> None:
    """Messages come at 10 Hz, without a pause; what holds them up is a callback that waits."""
    try:
        rate(run, topic, 10.0)
    except Missed as missed:
        missed.hint = slow_callback(run) or hint  # rate's own is for timers of another period
        raise


ADD, TOTAL = "/add_two_ints", "/ticks/total"
CURE = (
    "The answer arrives in a callback, too, and that can't run while look waits. Ask with call_async, and "
    "let a done callback publish the answer; or await it, with timer and client in a ReentrantCallbackGroup."
)
GROUPS = (
    "While look waits for an answer, or awaits it, nothing else of its callback group runs. Give its timer "
    "and the client a group of their own, a ReentrantCallbackGroup; or use a done callback."
)

ticks = Exercise("ticks", "A node that freezes", seconds=10, companions=[SlowAdder, Wheels], seeds=(1, 2))


@ticks.check(4)
def asks_every_second(run: Recording) -> list[Call]:
    """Once a second the node asks /add_two_ints."""
    made = has_client(run, ADD, "example_interfaces/srv/AddTwoInts")
    due = int(run.seconds) - 1
    if len(made) < 0.8 * due:
        hint = "Let a timer with a period of 1 s call look, and ask there: self.client.call_async(request)."
        stuck = any(call.received is None for call in made)
        raise Missed(f"{due} questions in {run.seconds:g} s", f"{len(made)}", CURE if stuck else hint)
    return made


@ticks.check(4, after=asks_every_second)
def publishes_the_totals(run: Recording, made: list[Call]) -> None:
    """Each answer is published on /ticks/total (Int64), as soon as it is there."""
    with hinting(guess="self.publisher.publish(Int64(data=answer.sum)), once the answer is there."):
        publishes(run, TOTAL, "std_msgs/msg/Int64")
    for call in made:
        if call.answered is None:
            continue
        total = call.response.sum
        sums = [value for _, value in series(run.during(call.answered, call.answered + 0.2), TOTAL, "data")]
        if total not in sums:
            raise Missed(
                f"{total} on {TOTAL}, the answer of {call.answered:.3g} s",
                f"{', '.join(map(str, sums)) or 'no message'} in the 0.2 s after it",
                guess="Publish the sum of the answer itself, once it is there: answer.sum.",
            )


@ticks.check(2, after=asks_every_second)
def asks_with_the_newest_ticks(run: Recording, made: list[Call]) -> None:
    """It asks for the sum of the newest ticks of both wheels."""
    counts = [series(run, f"/ticks/{side}", "data") for side in ("left", "right")]
    for call in made:
        # Two of each: a message of the very moment of the question may come before or after it.
        left, right = ([value for at, value in side if at <= call.requested][-2:] for side in counts)
        a, b = call.request.a, call.request.b
        if not (a in left and b in right) and not (b in left and a in right):
            hint = "AddTwoInts.Request(a=self.left, b=self.right), made anew for each question."
            raise Missed(f"a={left[-1]}, b={right[-1]}", question(call), hint)


@ticks.check(4, after=asks_with_the_newest_ticks)
def heart_goes_on(run: Recording) -> None:
    """The heart beats on at 10 Hz, also while the node waits for an answer."""
    _keeps_pace(run, "/heartbeat", GROUPS)
