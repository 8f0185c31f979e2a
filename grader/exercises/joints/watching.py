"""An exercise on limits: read them from the robot's description, and watch all joints by their names."""

from __future__ import annotations

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.joints import described_limits
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.joints.crew import gymnast
from grader.exercises.joints.places import arm_of
from sim.evidence import Recording, Seconds

NAME, STATES, STRING = "/near_limit", "sensor_msgs/msg/JointState", "std_msgs/msg/String"
NEAR, CLEAR = 0.1, 0.13  # rad: the margin in the task, and one that is not near for sure
SOON = 0.2  # s

limits = Exercise("limits", "Near the limit", world=arm_of, seconds=18, companions=gymnast, seeds=(1, 2))


class Visit(NamedTuple):
    """A joint that came near one of its limits, until it was away again."""

    name: str
    begin: Seconds
    end: Seconds


@limits.check(2)
def hears_both(run: Recording) -> None:
    """The node subscribes to /joint_states and to /robot_description."""
    with hinting("All drivers speak on /joint_states; what the arm looks like is on /robot_description."):
        subscribes(run, "/joint_states", STATES)
        subscribes(run, "/robot_description", STRING)


@limits.check(8, after=hears_both)
def names_those_near(run: Recording) -> list[Visit]:
    """The name of each joint that comes within 0.1 rad of a limit goes out on /near_limit, and no other."""
    with hinting(_why_silent(run)):
        said = [(one.stamp, one.message.data) for one in publishes(run, NAME, STRING)]
    visits = visits_of(run)
    for stamp, name in said:
        if not any(visit.name == name and visit.begin <= stamp < visit.end + SOON for visit in visits):
            raise Missed(
                "the name of a joint that is near one of its limits", f"“{name}” at {stamp:.3g} s",
                _why_wrong(run, stamp, name),
            )  # fmt: skip
    for visit in visits:
        if visit.begin > run.ended.stamp - SOON:
            continue  # it may still be said
        if not any(name == visit.name and visit.begin <= stamp < visit.begin + SOON for stamp, name in said):
            raise Missed(
                f"“{visit.name}” within {SOON:g} s of {visit.begin:.3g} s, when it comes near its limit",
                _instead(said, visit),
                "Look at both limits of each joint that the description names: position - lower, and "
                "upper - position. And remember that it was away, when it is.",
            )
    return visits


@limits.check(5, after=names_those_near)
def once_for_each(run: Recording, visits: list[Visit]) -> None:
    """Each time it comes near, it is named once, and not again as long as it stays there."""
    said = [(one.stamp, one.message.data) for one in run.messages(NAME)]
    for visit in visits:
        times = [
            stamp for stamp, name in said if name == visit.name and visit.begin <= stamp < visit.end + SOON
        ]
        if len(times) > 1:
            raise Missed(
                f"one “{visit.name}” from {visit.begin:.3g} s to {visit.end:.3g} s",
                f"{len(times)}",
                "Remember which joints are near already: a set of names. Speak when one comes in, and take "
                "it out when it is away.",
            )


def visits_of(run: Recording) -> list[Visit]:
    """When each joint was near a limit, by what our drivers said. Raises as `no_data` where none was."""
    known, open_, found = described_limits(run), {}, []
    for heard in run.messages("/joint_states"):
        if not heard.from_course:
            continue
        message = heard.message
        for name, position in zip(message.name, message.position, strict=True):
            if name not in known:
                continue
            lower, upper = known[name]
            margin = min(position - lower, upper - position)
            if margin < NEAR:
                open_.setdefault(name, heard.stamp)
            elif name in open_ and margin > CLEAR:
                found.append(Visit(name, open_.pop(name), heard.stamp))
    found += [Visit(name, begin, run.ended.stamp) for name, begin in open_.items()]
    if len(found) < 2:
        raise no_data(run, "two joints near a limit", f"{len(found)}", run.graph.publishers("/joint_states"))
    return sorted(found, key=lambda one: one.begin)


def _instead(said: list[tuple[Seconds, str]], visit: Visit) -> str:
    heard = [name for stamp, name in said if visit.begin <= stamp < visit.begin + SOON]
    return ", ".join(f"“{name}”" for name in heard) or "nothing"


def _why_wrong(run: Recording, stamp: Seconds, name: str) -> str:
    """The usual reasons for another name."""
    known = described_limits(run)
    if name not in known:
        return f"The description has no limits for it: it names {', '.join(known)}. Leave others alone."
    told = [one for one in run.messages("/joint_states") if one.from_course and one.stamp <= stamp][
        -1
    ].message
    lower, upper = known[name]
    others = [place for one, place in zip(told.name, told.position, strict=True) if one != name]
    if any(min(place - lower, upper - place) < NEAR for place in others):
        return (
            "That is another joint's position. Drivers list their joints in an order of their own: "
            "for name, position in zip(msg.name, msg.position)."
        )
    return (
        f"Its limits are {lower:g} and {upper:g} rad. Take them from the description of this robot; they are "
        "radians, as the positions are, and the lower one has a sign of its own."
    )


def _why_silent(run: Recording) -> str:
    """The usual reason for a node that says nothing; or no hint."""
    ends = [end for end in run.graph.subscriptions("/robot_description") if not end.from_course]
    if all(end.qos["durability"] == "volatile" for end in ends):
        return (
            "The description was sent once, before your node was there. Who wants to hear it asks for "
            "durability TRANSIENT_LOCAL."
        )
    return ""
