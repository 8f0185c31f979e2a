"""A state machine: fetch, deliver, charge, rest."""

from typing import Any

from grader.checks import Missed, publishes, rate
from grader.exercise import Exercise
from grader.exercises.delivery.decide.scripted_orders import Situation, desk, situations
from grader.geometry import Point, Pose2D
from grader.geometry.near import is_near
from grader.responses import Window, from_student, last_before
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds, since_start

__all__ = ["decide", "desk"]

GOAL, STATE = "/goal_pose", "/state"
LATE = 1.2  # s until a decision that comes twice a second has to hold
TOGETHER = 0.1  # s; the desk publishes a situation's orders one after the other, within so much of its begin
SAME = 0.02  # m
PAST = "Subscribe to /orders with LATCHED, and store orders by their id: a later message replaces it."

decide = Exercise("decide", "Decide: what next?", seconds=39, companions=desk, seeds=(1, 2),
                  variants=Variants(
    {"deliver": ("deliver", "carry")},  # states
    {"charge": ("charge", "recharge")},
    {"rest": ("rest", "park")},
    texts=("**{deliver}**", '"{deliver}"', "**{charge}**", '"{charge}"', "**{rest}**", '"{rest}"'),
))


@decide.check(2)
def decides(run: Recording) -> None:
    """The node publishes PoseStamped messages on /goal_pose and String messages on /state."""
    publishes(run, GOAL, "geometry_msgs/msg/PoseStamped")
    publishes(run, STATE, "std_msgs/msg/String")


@decide.check(2, after=decides)
def knows_latched_messages(run: Recording) -> None:
    """It knows what was published before it started: the last message about each order counts."""
    _compare(run, "past", PAST)


@decide.check(4, after=decides)
def delivers_first(run: Recording) -> None:
    """A robot that carries a load delivers it, whatever else is requested."""
    _compare(run, "delivers", "Look for an order that is PICKED_UP before you check anything else.")


@decide.check(4, after=decides)
def charges(run: Recording) -> None:
    """It charges below 30 %, then until 80 %, and not in between."""
    hint = ("Use two limits: below 0.3 it starts charging; below 0.8 it continues if the last state was "
            f"{decide.drawn.charge}.")
    _compare(run, "charges", hint)


@decide.check(4, after=decides)
def gives_up(run: Recording) -> None:
    """It drops orders that are over, and those that can no longer be delivered in time."""
    hint = "Fetch an order only while it is WAITING and has more time left than it takes; check every time."
    _compare(run, "gives up", hint)


@decide.check(3, after=decides)
def keeps_to_one(run: Recording) -> None:
    """It takes the most urgent order, and then stays with the one it has begun."""
    hint = ("Stay with the order you began as long as it can be delivered; otherwise take the earliest "
            "deadline.")
    _compare(run, "keeps", hint)


RULES = {
    "past": knows_latched_messages, "delivers": delivers_first, "charges": charges, "gives up": gives_up,
    "keeps": keeps_to_one,
}


@decide.check(1, after=decides)
def has_the_frame_map(run: Recording) -> None:
    """Goals are in the frame map, as /dock_pose and the orders are."""
    _require_a_decision(run)
    for goal in from_student(run, GOAL):
        frame = goal.message.header.frame_id
        if frame != "map":
            hint = "Publish the pose of the order or the dock unchanged: it contains header.frame_id."
            raise Missed(f"the frame “map” on {GOAL}", f"“{frame}” at {goal.stamp:.3g} s", hint)


@decide.check(2, after=decides)
def publishes_twice_a_second(run: Recording) -> None:
    """It publishes the goal twice a second, without a pause."""
    _require_a_decision(run)
    for topic in (GOAL, STATE):
        rate(run, topic, 2.0, tolerance=0.15)


def _require_a_decision(run: Recording) -> None:
    """Raise Missed if no rule is kept: the rules explain it, and who decides nothing earns nothing."""
    for about in RULES:
        try:
            return _compare(run, about, "")
        except Missed as missed:
            last = missed
    last.because = tuple(RULES.values())
    raise last


def _compare(run: Recording, about: str, hint: str) -> None:
    """Raises Missed at the first situation that tests this rule and in which something else was decided."""
    for one in situations(run.seed, about):
        begin, wanted = one.begin + LATE, vars(decide.drawn).get(one.state, one.state)
        window = Window(begin, run.ended.stamp).before(one.end)
        goals, states = (_decided(run, topic, window) for topic in (GOAL, STATE))
        expected = f"“{wanted}” and {_text(one.place)} from {begin:.3g} s on, because {one.reason}"
        if not (goals and states):
            saw = f"nothing published from {begin:.3g} s to {one.end:.3g} s"
            raise Missed(expected, saw, hint, picture="topics")
        places = _places(run, one)
        for state, goal in zip(states, goals, strict=False):
            place = Pose2D.from_message(goal.message.pose)[:2]
            if state.message.data != wanted or not any(is_near(place, each, SAME) for each in places):
                saw = f"“{state.message.data}” and {_text(place)} at {goal.stamp:.3g} s"
                first = () if about == "past" else (knows_latched_messages,)
                raise Missed(expected, saw, hint, picture="topics", because=first)


def _decided(run: Recording, topic: str, window: Window) -> list[Message]:
    """Return what was published in a window; where that is nothing, what was last published before."""
    sent = from_student(run, topic)
    return window.rows(sent) or list(filter(None, [last_before(sent, window.begin)]))


def _places(run: Recording, one: Situation) -> list[Point]:
    """Return where it may go: a decision between orders that arrive together knows only the first of them."""
    came = [row for row in run.received("/orders") if 0 <= _published(row) - one.begin + 1e-6 < TOGETHER]
    if not run.order or len(came) < 2 or one.about != "keeps":
        return [one.place]
    decided = Window(came[0].stamp, came[-1].stamp).rows(from_student(run, GOAL))
    known = [row.message for row in came if decided and row.stamp <= decided[-1].stamp]
    urgent = [min(known[:count], key=_deadline) for count in range(1, len(known) + 1)]
    return [one.place, *(Pose2D.from_message(order.pickup.pose)[:2] for order in urgent)]


def _published(row: Message) -> Seconds:
    return since_start(row.message.header.stamp)


def _deadline(order: Any) -> Seconds:
    return since_start(order.deadline)


def _text(place: Point) -> str:
    return f"({place[0]:.2f}, {place[1]:.2f})"
