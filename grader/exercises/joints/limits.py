"""Read the joints' limits from the robot's description, and name each joint that comes near one."""

from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.checks.check import Hints
from grader.checks.joints import described_limits
from grader.checks.no_data import no_data
from grader.companions.joint_targets import gymnast
from grader.exercise import Exercise
from grader.responses import Window, from_course, last_before, text_of
from grader.variants import Variants
from grader.worlds.arms import arm_of
from sim.evidence import Message, Recording, Seconds

STRING = "std_msgs/msg/String"
NEAR, CLEAR = 0.1, 0.13  # rad: the margin in the task, and one that no noise reaches from there
SOON = 0.2  # s
SOME = 0.5  # of the points, where a third of the joints that come near are named, or more

limits = Exercise("limits", "Near the limit", world=arm_of, seconds=18, companions=gymnast, seeds=(1, 2),
                  variants=Variants(
    {"topic": ("/near_limit", "/limit_warning", "/at_limit")}, texts=("{topic}",),
))


class Visit(NamedTuple):
    """A joint near one of its limits, until it is away again."""

    name: str
    begin: Seconds
    end: Seconds

    def names(self, messages: list[Message], until: Seconds) -> list[Message]:
        """Return the messages that name the joint in the time up to `until`."""
        inside = Window(self.begin, until).rows(messages)
        return [row for row in inside if row.message.data == self.name]


@limits.check(2)
def subscribes_to_both(run: Recording) -> None:
    """The node subscribes to /joint_states and to /robot_description."""
    with hinting("All drivers publish on /joint_states; the arm's structure is on /robot_description."):
        subscribes(run, "/joint_states", "sensor_msgs/msg/JointState")
        subscribes(run, "/robot_description", STRING)


OTHERS: Hints = {
    "The description was published once, before your node was there. To receive it, request durability "
    "TRANSIENT_LOCAL.": lambda run: all(
        end.qos["durability"] == "volatile"
        for end in run.graph.subscriptions("/robot_description")
        if not end.from_course
    ),
    "The description has no limits for this joint: it names {names}. Ignore other "
    "joints.": lambda run, wrong: (
        wrong.message.data not in described_limits(run) and {"names": ", ".join(described_limits(run))}
    ),
    "That is another joint's position. Each driver lists its joints in its own order: for "
    "name, position in zip(msg.name, msg.position).": lambda run, wrong: _another_is_near(run, wrong),
    "Its limits are {lower:g} and {upper:g} rad. Take them from this robot's description; they are in "
    "radians, like the positions, and the lower one has its own sign.":
        lambda run, wrong: described_limits(run)[wrong.message.data]._asdict(),
}


@limits.check(4, after=subscribes_to_both, hints=OTHERS)
def names_those_near(run: Recording) -> list[Visit]:
    """The name of each joint that comes within 0.1 rad of a limit is sent on /near_limit."""
    messages, visits = publishes(run, limits.drawn.topic, STRING), _visits(run)
    others = _others(messages, visits)
    if 2 * len(others) > len(messages):
        raise _another(others)
    named = [visit for visit in visits if visit.names(messages, visit.begin + SOON)]
    for visit in visits:
        window = Window.after(visit.begin, SOON)
        if window.is_over(run) and not visit.names(messages, window.end):
            raise Missed(
                f"“{visit.name}” within {SOON:g} s of {visit.begin:.3g} s, when it comes near its limit",
                ", ".join(text_of(row.message.data) for row in window.rows(messages)) or "nothing",
                "Check both limits of each joint that the description names: position - lower, and "
                "upper - position. And record when it is away from them again.",
                credit=SOME if 3 * len(named) >= len(visits) else 0.0, measured=named,
            )
    return visits


@limits.check(4, after=names_those_near, hints=OTHERS)
def names_no_other(run: Recording, visits: list[Visit]) -> None:
    """No other joint is named."""
    others = _others(run.messages(limits.drawn.topic), _visits(run))
    if others:
        raise _another(others)


@limits.check(5, after=names_those_near, hints={
    "The encoders are noisy: a joint that rests at the margin or at a limit seems to leave and come back. "
    "Remove it from the set of near ones only when it is more than 0.15 rad from both limits.":
        lambda run, visit, count: count < _states_near(run, visit),
    "Store which joints are already near, in a set of names. Publish when you add one, and remove it when it "
    "is away again.": otherwise,
})
def once_for_each(run: Recording, visits: list[Visit]) -> None:
    """Each time a joint comes near, it is named once, and not again as long as it stays there."""
    for visit in visits:
        count = len(visit.names(run.messages(limits.drawn.topic), visit.end + SOON))
        if count > 1:
            expected = f"one “{visit.name}” from {visit.begin:.3g} s to {visit.end:.3g} s"
            raise Missed(expected, f"{count}", about=(visit, count))


def _others(messages: list[Message], visits: list[Visit]) -> list[Message]:
    """The messages that name a joint which is not near a limit."""
    return [row for row in messages if not any(visit.names([row], visit.end + SOON) for visit in visits)]


def _another(others: list[Message]) -> Missed:
    saw = f"“{others[0].message.data}” at {others[0].stamp:.3g} s"
    return Missed("the name of a joint that is near one of its limits", saw, about=(others[0],))


def _visits(run: Recording) -> list[Visit]:
    """Return when each joint was near a limit, by the joint states of the course's drivers."""
    known, found = described_limits(run), []
    since: dict[str, Seconds] = {}
    for row in from_course(run, "/joint_states"):
        for name, position in zip(row.message.name, row.message.position, strict=True):
            if name not in known:
                continue
            margin = known[name].margin(position)
            if margin < NEAR:
                since.setdefault(name, row.stamp)
            elif name in since and margin > CLEAR:
                found.append(Visit(name, since.pop(name), row.stamp))
    found += [Visit(name, begin, run.ended.stamp) for name, begin in since.items()]
    if len(found) < 2:
        raise no_data(run, "two joints near a limit", f"{len(found)}", run.graph.publishers("/joint_states"))
    return sorted(found, key=lambda visit: visit.begin)


def _states_near(run: Recording, visit: Visit) -> int:
    """Return how many joint states of a visit have the joint within the margin."""
    found = 0
    for row in Window(visit.begin, visit.end).rows(from_course(run, "/joint_states")):
        places = dict(zip(row.message.name, row.message.position, strict=True))
        found += visit.name in places and described_limits(run)[visit.name].margin(places[visit.name]) < NEAR
    return found


def _another_is_near(run: Recording, wrong: Message) -> bool:
    """Return whether a position that was published last for another name is near this joint's limit."""
    name, last = wrong.message.data, last_before(from_course(run, "/joint_states"), wrong.stamp)
    places = zip(last.message.name, last.message.position, strict=True) if last else ()
    others = [place for other, place in places if other != name]
    return any(described_limits(run)[name].margin(place) < NEAR for place in others)
