"""Name the faults of six systems, and fix them."""

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.silence.doctor.silent_systems import FAULTS, PAUSE, SilentSystem, cases, silent_systems
from grader.responses import EDGE, Window, from_course
from sim.evidence import Recording, Seconds

__all__ = ["doctor", "silent_systems"]

STRING = "std_msgs/msg/String"
GIVEN_AWAY = 2  # right answers, or systems fixed, that earn nothing: they may be right by chance
# The parameter that fixes a fault; where there is no sensor, none does.
SETTINGS = {"reliability", "durability", "deadline"}
CURES = {"name": "topic", "mute": "running"} | {name: name for name in SETTINGS}
CHANGES_ALL = ("Changing everything fixes the fault only by chance, and breaks what worked. Find the "
               "fault first.")
WHY = {
    "name": "A publisher uses nearly this name. Compare it with all topics: get_topic_names_and_types().",
    "missing": "get_publishers_info_by_topic(topic) is empty, and no other topic has a similar name.",
    "reliability": "The sensor offers best effort, and the display requests reliable.",
    "durability": "The display requests transient local, and the sensor is volatile.",
    "deadline": "The display requests a shorter deadline than the sensor offers; no deadline is the longest.",
    "mute": "All settings match, and still nothing arrives: the sensor is there, but doesn't publish.",
}

doctor = Exercise("doctor", "A doctor for silent systems", seconds=9, companions=silent_systems, seeds=(1, 2))


class Diagnosed(NamedTuple):
    """A system with a complaint, and what was done about it."""

    stamp: Seconds  # of the complaint
    case: SilentSystem
    words: tuple[str, ...]  # that the student's node published about it
    receives: bool  # whether its display receives something in the end
    changes: tuple[str, ...]  # the parameters of its display that were set

    @property
    def idle(self) -> list[str]:
        """Return those of them that don't fix its fault."""
        return [name for name in self.changes if name != CURES.get(self.case.fault, "")]


@doctor.check(2)
def answers_complaints(run: Recording) -> None:
    """The node subscribes to /complaint, and publishes String messages on /diagnosis."""
    with hinting("`on_message`, the callback of /complaint, publishes what `examine` returns."):
        subscribes(run, "/complaint", STRING)
        publishes(run, "/diagnosis", STRING)


@doctor.check(10, after=answers_complaints, hints={
    "Publish one message for each complaint: return as soon as you have found the fault.":
        lambda run, one: len(one.words) > 1,
    "Use one of these words: {faults}.":
        lambda run, one: not set(one.words) <= set(FAULTS) and {"faults": ", ".join(FAULTS)},
    "Publish the complaint's topic, a colon and the word; `on_message` does so if examine returns the word.":
        lambda run, one: not one.words,
    "Different settings may still match: a sensor may offer more than the display "
    "requests. Here the fault is: {why}":
        lambda run, one: set(one.words) <= SETTINGS and {"why": WHY[one.case.fault]},
    "{why}": lambda run, *about: about and {"why": WHY[about[0].case.fault]},
})
def names_the_faults(run: Recording) -> None:
    """For each complaint it names the fault, in one message and within a second: “/kitchen/speech: name”."""
    systems = _systems(run)
    first = next((one for one in systems if one.words != (one.case.fault,)), None)
    if first:
        right = sum(one.words == (one.case.fault,) for one in systems)
        expected = f"“{first.case.topic}: {first.case.fault}” after the complaint at {first.stamp:.3g} s"
        saw = ", ".join(f"“{word}”" for word in first.words) or "nothing"
        saw = f"{saw}; {right} of {len(systems)} are right"
        raise Missed(expected, saw, credit=_share(right, len(systems)), about=(first,))


@doctor.check(8, after=answers_complaints)
def fixes_the_faults(run: Recording) -> None:
    """It fixes only the fault: every display receives from its sensor again, if there is one."""
    systems = [one for one in _systems(run) if one.case.fault != "missing"]
    broken = [one for one in systems if not one.receives or one.idle]
    if broken:
        first, right = broken[0], len(systems) - len(broken)
        done = f"{', '.join(first.changes)} was set"
        if not first.changes:
            done = "nothing was set at the display, or the change was refused"
        expected = f"the display of {first.case.topic} receiving again: the fault is “{first.case.fault}”"
        saw = f"it receives {'again' if first.receives else 'nothing'}, and {done}; "
        saw += f"{right} of {len(systems)} were fixed so"
        hint = CHANGES_ALL if first.idle else _why_broken(first)
        raise Missed(expected, saw, hint, credit=_share(right, len(systems)))


@doctor.check(2, after=fixes_the_faults)
def touches_nothing_else(run: Recording) -> None:
    """It sets only what is wrong: nothing on a display without a sensor, and no other parameter."""
    for one in _systems(run):
        if one.idle:
            needed = CURES.get(one.case.fault, "")
            expected = f"{f'{needed} alone' if needed else 'nothing'} set at the display of {one.case.topic}"
            raise Missed(expected, ", ".join(dict.fromkeys(one.changes)), CHANGES_ALL)


def _share(right: int, of: int) -> float:
    return max(0.0, (right - GIVEN_AWAY) / (of - GIVEN_AWAY))


def _systems(run: Recording) -> list[Diagnosed]:
    """All systems with a complaint."""
    known = {case.topic: case for case in cases(run.seed)}
    displayed = from_course(run.during(run.ended.stamp - PAUSE), "/received", at_least=0)
    texts = {row.message.data for row in displayed}
    changes = [row.message.data.split() for row in from_course(run, "/changes", at_least=0)]
    found = []
    for complaint in from_course(run, "/complaint", what="complaints"):
        topic = complaint.message.data
        answers = Window.after(complaint.stamp, PAUSE - 2 * EDGE).rows(run.messages("/diagnosis"))
        parts = [row.message.data.partition(":") for row in answers]
        words = tuple(word.strip() for name, _, word in parts if name.strip() == topic)
        set_here = tuple(name for where, name in changes if where == topic)
        published = from_course(run, known[topic].spoken, at_least=0)
        receives = any(f"{topic} {row.message.data}" in texts for row in published)
        found.append(Diagnosed(complaint.stamp, known[topic], words, receives, set_here))
    return found


def _why_broken(one: Diagnosed) -> str:
    """Return what to do where a display still receives nothing."""
    fault = one.case.fault
    if fault == "mute":
        return "The sensor has the parameter `running`: set it to True, on the sensor and not on the display."
    if CURES[fault] in one.changes:
        return {
            "name": "Set `topic` to the name that the sensor uses, with its namespace.",
            "deadline": "Set `deadline` to what the sensor offers or more, in seconds; 0.0 is no deadline.",
        }.get(fault, f"Set `{CURES[fault]}` to what the sensor offers: its name in lower case.")
    return f"Set `{CURES[fault]}` of the display to what the sensor offers. The sensor's settings are fixed."
