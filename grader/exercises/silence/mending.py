"""The last exercise: name the faults of six systems, and mend them."""

from __future__ import annotations

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.silence.ward import FAULTS, PAUSE, Case, cases, ward
from sim.evidence import Recording, Seconds

STRING = "std_msgs/msg/String"
GIVEN_AWAY = 2  # right words, or systems that hear again, that earn nothing: they may be right by chance
CURES = {
    "name": "topic",
    "reliability": "reliability",
    "durability": "durability",
    "deadline": "deadline",
    "mute": "running",
}  # the parameter that mends a fault; where nobody is there, none does
CHANGES_ALL = "If you change everything, you mend by chance, and break what was right. Find the fault first."

doctor = Exercise("doctor", "A doctor for silent systems", seconds=9, companions=ward, seeds=(1, 2))


class Patient(NamedTuple):
    """A system of which somebody complained, and what was done about it."""

    stamp: Seconds  # of the complaint
    case: Case
    words: tuple[str, ...]  # that the student's node said of it
    hears: bool  # whether its display hears something in the end
    changes: tuple[str, ...]  # the parameters of its display that were set

    @property
    def idle(self) -> list[str]:
        """Those of them that don't mend its fault."""
        return [name for name in self.changes if name != CURES.get(self.case.fault, "")]


@doctor.check(2)
def answers_complaints(run: Recording) -> None:
    """The node hears /complaint, and publishes String messages on /diagnosis."""
    with hinting("The callback of /complaint is `hear`: it publishes what `examine` returns."):
        subscribes(run, "/complaint", STRING)
        publishes(run, "/diagnosis", STRING)


@doctor.check(10, after=answers_complaints)
def names_the_faults(run: Recording) -> None:
    """For each complaint it names the fault, in one message and within a second: “/kitchen/speech: name”."""
    patients = _patients(run)
    wrong = [one for one in patients if one.words != (one.case.fault,)]
    if wrong:
        first = wrong[0]
        said = ", ".join(f"“{word}”" for word in first.words) or "nothing"
        raise Missed(
            f"“{first.case.topic}: {first.case.fault}” after the complaint at {first.stamp:.3g} s",
            f"{said}; {len(patients) - len(wrong)} of {len(patients)} are right",
            _why_wrong_word(first),
            credit=_share(len(patients) - len(wrong), len(patients)),
        )


@doctor.check(8, after=answers_complaints)
def mends_the_faults(run: Recording) -> None:
    """It mends the fault, by that alone: every display hears its sensor again, where there is one."""
    patients = [one for one in _patients(run) if one.case.fault != "nobody"]
    deaf = [one for one in patients if not one.hears or one.idle]
    if deaf:
        first = deaf[0]
        done = (
            f"{', '.join(first.changes)} was set"
            if first.changes
            else "nothing was set at the display, or it was refused"
        )
        raise Missed(
            f"the display of {first.case.topic} hearing again: the fault is “{first.case.fault}”",
            f"it hears {'again' if first.hears else 'nothing'}, and {done}; "
            f"{len(patients) - len(deaf)} of {len(patients)} were mended so",
            CHANGES_ALL if first.idle else _why_deaf(first),
            credit=_share(len(patients) - len(deaf), len(patients)),
        )


@doctor.check(2, after=mends_the_faults)
def touches_nothing_else(run: Recording) -> None:
    """It sets only what is at fault: nothing at a display that waits for nobody, and no other parameter."""
    for one in _patients(run):
        if one.idle:
            needed = CURES.get(one.case.fault, "")
            expected = f"{f'{needed} alone' if needed else 'nothing'} set at the display of {one.case.topic}"
            raise Missed(expected, ", ".join(dict.fromkeys(one.changes)), CHANGES_ALL)


def _share(right: int, of: int) -> float:
    return max(0.0, (right - GIVEN_AWAY) / (of - GIVEN_AWAY))


def _patients(run: Recording) -> list[Patient]:
    """All systems of which ours have complained."""
    complaints = [heard for heard in run.messages("/complaint") if heard.from_course]
    known = {case.topic: case for case in cases(run.seed)}
    late = run.ended.stamp - PAUSE
    told = run.during(late, run.ended.stamp + 1.0).messages("/heard")
    heard = {one.message.data for one in told if one.from_course}
    if not complaints:
        raise no_data(run, "complaints", "none", run.graph.publishers("/complaint"))
    found = []
    for complaint in complaints:
        topic, begin = complaint.message.data, complaint.stamp
        told = [one for one in run.messages("/diagnosis") if begin <= one.stamp < begin + PAUSE]
        texts = [one.message.data.partition(":") for one in told]
        words = [word.strip() for name, _, word in texts if name.strip() == topic]
        changes = [one.message.data.split() for one in run.messages("/changes") if one.from_course]
        set_here = tuple(name for where, name in changes if where == topic)
        hears = any(f"{topic} {word}" in heard for word in _spoken(run, known[topic]))
        found.append(Patient(begin, known[topic], tuple(words), hears, set_here))
    return found


def _spoken(run: Recording, case: Case) -> set[str]:
    """What the sensor of a system has said, and nobody in its place."""
    return {one.message.data for one in run.messages(case.spoken) if one.from_course}


_WHY = {
    "name": "A publisher has nearly this name. Compare with all topics: get_topic_names_and_types().",
    "nobody": "get_publishers_info_by_topic(topic) is empty, and no other name is nearly the same.",
    "reliability": "The sensor offers best effort, and the display asks for reliable.",
    "durability": "The display asks for transient local, and the sensor is volatile.",
    "deadline": "The display asks for a shorter deadline than the sensor offers; none at all is longest.",
    "mute": "All settings fit, and still nothing comes: the sensor is there, and doesn't speak.",
}


def _why_wrong_word(one: Patient) -> str:
    """What to look at where the word is another one."""
    if len(one.words) > 1:
        return "One message for each complaint: return as soon as the fault is found."
    if one.words and one.words[0] not in FAULTS:
        return f"The words are {', '.join(FAULTS)}."
    if not one.words:
        return "Publish the topic of the complaint, a colon and the word; `hear` does it if examine returns."
    if one.words[0] in ("reliability", "durability", "deadline"):
        return (
            "Settings that differ may fit: a sensor may offer more than the display asks for. "
            f"Here it is this: {_WHY[one.case.fault]}"
        )
    return _WHY[one.case.fault]


def _why_deaf(one: Patient) -> str:
    """What to do where a display still hears nothing."""
    fault = one.case.fault
    if fault == "mute":
        return "The sensor has the parameter `running`: set it to True, at the sensor and not at the display."
    if CURES[fault] in one.changes:
        return {
            "name": "Set `topic` to the name that the sensor uses, with its namespace.",
            "deadline": "Set `deadline` to what the sensor offers or more, in seconds; 0.0 is no limit.",
        }.get(fault, f"Set `{CURES[fault]}` to what the sensor offers: its name in small letters.")
    return f"Set `{CURES[fault]}` of the display to what the sensor offers. A sensor's are fixed."
