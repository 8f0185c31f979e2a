"""A client that gets what it wants from a door, and goes on meanwhile."""

import itertools

from grader.checks import Missed, series
from grader.checks.services import has_client, is_refusal, is_success, sent_at
from grader.checks.topics import keeps_pace
from grader.companions.service_servers import Door
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import Window
from grader.variants import Variants
from sim.evidence import Call, Recording, Seconds

WAITING = ("While a callback or __init__ waits, nothing else in the node can run, and no response can "
           "arrive. Send the request, return, and let the done callback do the rest.")
OPEN = "/door/open"

door = Exercise("door", "A visitor at the door", world="yard", seconds=14, companions=[Door], seeds=(1, 2),
                variants=Variants(
    {"speed": (0.3, 0.2, 0.25)},
    texts=("drives at {speed:g} m/s", "self.speed = {speed:g}"),
))


@door.check(4)
def calls_the_door(run: Recording) -> list[Call]:
    """The node calls /door/open (Trigger), although the door starts late."""
    made = has_client(run, OPEN, "std_srvs/srv/Trigger")
    taken = [call for call in made if call.taken is not None]
    lost = [call for call in made if call.lost]
    answered = [call for call in made if call.answered is not None]
    if lost or not taken:
        hint = ("A request to a service that isn't there yet is lost. Let a timer check once a second, and "
                "call only when self.client.service_is_ready(), with parentheses, is True.")
        saw = f"{len(lost)} sent too early, the first at {lost[0].requested:.3g} s" if lost else "no request"
        credit = 0.5 if taken else 0.0
        raise Missed("requests to the door, once its service is there", saw, hint, credit=credit,
                     measured=answered)
    if all(call.received is None for call in taken):
        saw = f"a request at {taken[0].requested:.3g} s, whose response was never received"
        raise Missed("a request, and its response", saw, WAITING)
    return answered


@door.check(3, after=calls_the_door)
def keeps_driving_commands(run: Recording) -> None:
    """While it waits, the node keeps working: it publishes a command on /cmd_vel 10 times a second."""
    keeps_pace(run, "/cmd_vel", WAITING)


@door.check(3, after=calls_the_door,
            guess="In the done callback: answer = future.result(). If answer.success is False: "
            "self.get_logger().warning(answer.message).")
def warns_of_a_refusal(run: Recording, answered: list[Call]) -> None:
    """Each refusal is logged as a warning, with the door's message."""
    for call in filter(is_refusal, answered):
        message = call.response.message
        soon = Window.after(_answered_at(call), 0.6).rows(run.logs)
        lines = [line for line in soon if message in line.text]
        if not any(line.level == "WARN" for line in lines):
            saw = f"“{lines[0].text}” at level {lines[0].level}" if lines else "no line with this text"
            raise Missed(f"a warning with “{message}” at {call.answered:.3g} s", saw)


@door.check(3, after=calls_the_door)
def calls_until_yes(run: Recording, answered: list[Call]) -> None:
    """After a refusal it calls again, about once a second; after a success it doesn't."""
    pauses = [sent_at(after) - _answered_at(before) for before, after in itertools.pairwise(answered)]
    if pauses and max(pauses) < 0.3:
        saw = f"{max(pauses):.2g} s" if max(pauses) >= 0 else "it calls again before the response has arrived"
        guess = "Call only from the timer, once a second: not in a loop, and not from the done callback."
        raise Missed("a pause of about a second before the next call", saw, guess=guess)
    yes = _yes(answered)
    if yes is None:
        saw = "none that it answered"
        if answered:
            last = answered[-1].requested
            saw = f"{len(answered)} in all, the last at {last:.3g} s, and that one was refused"
        guess = "Let a timer call once a second, for as long as the door refuses."
        raise Missed("calls until the door says yes", saw, guess=guess)
    late = [call for call in answered if sent_at(call) > _answered_at(yes)]
    if late:
        saw = f"{len(late)}, the first at {late[0].requested:.3g} s"
        guess = "Once the door is open, stop calling: self.timer.cancel()."
        raise Missed("no call after the yes", saw, guess=guess)


@door.check(3, after=calls_the_door)
def drives_through_the_open_door(run: Recording, answered: list[Call]) -> None:
    """It stands still until the door opens, and then drives at 0.3 m/s."""
    yes = _yes(answered)
    opened = _answered_at(yes) if yes else run.ended.stamp
    commands = series(run, "/cmd_vel", "linear.x")
    early = [(at, speed) for at, speed in commands if speed and at < opened]
    if early:
        saw = f"{early[0][1]:g} m/s at {early[0][0]:.3g} s, with the door closed"
        hint = "Not every answer is a yes: check answer.success before you drive."
        raise Missed("linear.x 0 until the door is open", saw, hint, unsafe=True)
    wanted = door.drawn.speed
    late = [(at, speed) for at, speed in commands if at > opened + 0.5 and not is_near(speed, wanted, 0.03)]
    if late or not yes:
        saw = f"linear.x {late[0][1]:g} m/s at {late[0][0]:.3g} s" if late else "no yes from the door"
        guess = f"In the done callback, when answer.success is True: self.speed = {wanted}."
        raise Missed(f"{wanted} m/s once the door has said yes", saw, guess=guess)


def _answered_at(call: Call) -> Seconds:
    assert call.answered is not None  # `calls_the_door` picked it
    return call.answered


def _yes(calls: list[Call]) -> Call | None:
    return next(filter(is_success, calls), None)
