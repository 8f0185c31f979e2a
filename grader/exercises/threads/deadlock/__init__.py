"""A program that hangs: read its thread dump, and repair it without losing what runs at the same time."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.threads.deadlock.dump_reading import RESPONSE, right_answers
from grader.exercises.threads.deadlock.given import DEPOT, DUMP
from grader.exercises.threads.deadlock.job_site import DOWN, JOBS, LOAD, SWEEP, UP, job_site
from grader.responses import EDGE, from_course, from_student
from sim.evidence import Message, Recording, Seconds

__all__ = ["DEPOT", "DUMP", "deadlock", "job_site"]

DONE, PLACES, ANSWERS, SCALE = "/done", "/places", "/dump", "/scale"
TEXT = "std_msgs/msg/String"
DRIVING = 0.15  # s
PHASES = {UP: ["corridor", "corridor lift"], DOWN: ["lift", "corridor lift"],
          SWEEP: ["corridor", "corridor"], LOAD: ["lift"]}  # fmt: skip
ALONE = 0.3  # s that each job takes if it waits for no other
MOST = 1.3  # times as long as a right program takes

# The course's programs and the student's begin together, so that no time is left for a late start.
deadlock = Exercise("deadlock", "Nothing moves", seconds=1.8, companions=job_site, seeds=tuple(range(1, 9)),
                    waits=False)  # fmt: skip

READ_LIKE_THIS = ("A thread waits in its topmost line of depot.py. It holds what the `with` lines around "
                  "that line have taken, and not what that line itself asks for.")  # fmt: skip
LEAVE_FIRST = ("A job needs a place's lock until it has left the place. Between two drives it is still in "
               "the place of the first one, also while it waits for a lock.")  # fmt: skip


class FinishedJob(NamedTuple):
    """A job that was ordered: its name and number, when it arrived, and when it was done (s)."""

    name: str
    number: int
    began: Seconds
    done: Seconds


class JobDrive(NamedTuple):
    """A job's drive in some places, and from when until when (s)."""

    job: str
    places: str
    begin: Seconds
    end: Seconds


@deadlock.check(3)
def reads_the_dump(run: Recording) -> None:
    """/dump names the callbacks that hold the corridor and the lift, and the one that needs a response."""
    right = right_answers(DEPOT, DUMP)
    with hinting("The given lines publish what answers() returns: its values are the three names."):
        texts = [row.message.data for row in publishes(run, ANSWERS, TEXT)]
    found = {what.strip(): callback.strip() for what, _, callback in (text.partition(":") for text in texts)}
    wrong = [what for what in right if found.get(what) != right[what]]
    if wrong:
        does = "waits for a response" if wrong[0] == RESPONSE else f"holds the {wrong[0]}"
        saw = f"“{wrong[0]}: {found.get(wrong[0], '')}”; {len(right) - len(wrong)} of {len(right)} are right"
        credit = 1 - len(wrong) / len(right)
        raise Missed(f"“{wrong[0]}: ” and the callback that {does}", saw, READ_LIKE_THIS, credit=credit)


@deadlock.check(1)
def has_its_topics(run: Recording) -> None:
    """The node subscribes to /up, /down, /sweep and /load, and publishes on /done and /places."""
    for name in JOBS:
        subscribes(run, f"/{name}", "std_msgs/msg/Int32")
    publishes(run, DONE, TEXT)
    publishes(run, PLACES, TEXT)


@deadlock.check(2, after=has_its_topics, hints={
    "`load` waits for a response. Which group is the client in, and is a thread free to receive it?":
        lambda run, missing: LOAD in missing and DOWN not in missing,
    "Do each job to its end: a job that was given up isn't done. Publish its name and its number on /done.":
        otherwise,
})  # fmt: skip
def finishes_all(run: Recording) -> list[FinishedJob]:
    """Each job is reported on /done once, in each order and whatever comes first; a load with its weight."""
    ordered = [(name, row) for name in JOBS for row in from_course(run, f"/{name}")]
    reports = [(row.stamp, row.message.data) for row in from_student(run, DONE)]
    found = {name: [pair for pair in reports if pair[1].split()[:1] == [name]] for name, _ in ordered}
    missing = {name for name in found if not found[name]}
    for name, row in ordered:
        expected = f"“{_report(run, name, row)}” on {DONE}, for the job of {row.stamp:.3g} s"
        saw = [text for _, text in found[name]]
        if not saw:
            raise Missed(expected, "nothing until the end of the run", about=(missing,))
        if saw != [_report(run, name, row)]:
            hint = "Report each job once, when it is done; a load with the weight in the response of /scale."
            raise Missed(expected, ", ".join(f"“{text}”" for text in saw[:4]), hint)
    return [FinishedJob(name, row.message.data, row.stamp, found[name][0][0]) for name, row in ordered]


@deadlock.check(3, after=finishes_all)
def shares_no_place(run: Recording, jobs: list[FinishedJob]) -> None:
    """All drives of the given program are driven, and no two jobs are in the same place at the same time."""
    with hinting("Leave the drives as they are, and publish on /places what `drive` publishes."):
        drives = list(_drives(run))
        for job in jobs:
            driven = [drive for drive in drives if drive.job == job.name]
            places = [" ".join(sorted(drive.places.split())) for drive in driven]
            if places != PHASES[job.name] or any(d.end - d.begin < DRIVING - EDGE for d in driven):
                saw = ", ".join(f"{drive.places} for {drive.end - drive.begin:.3g} s" for drive in driven)
                expected = f"{job.name} in {', then in '.join(PHASES[job.name])}, for {DRIVING:g} s each"
                raise Missed(expected, saw or "no drive")
    for one, other in itertools.combinations(_stays(drives), 2):
        both = {*one.places.split()} & {*other.places.split()}
        if both and one.job != other.job and min(one.end, other.end) > max(one.begin, other.begin) + EDGE:
            place, since = both.pop(), max(one.begin, other.begin)
            saw = f"{one.job} and {other.job} at {since:.3g} s"
            raise Missed(f"one job at a time in the {place}", saw, LEAVE_FIRST)


@deadlock.check(3, after=finishes_all)
def stays_concurrent(run: Recording, jobs: list[FinishedJob]) -> None:
    """Jobs that need different places run at the same time: at most 1.3 times as long as a right program."""
    times = {job.name: job for job in jobs}
    for names, in_turns in (((UP, DOWN), True), ((SWEEP, LOAD), False)):
        first, second = sorted((times[name] for name in names), key=lambda job: job.began)
        begin = max(second.began, first.began + ALONE) if in_turns else second.began
        most, took = MOST * (begin + ALONE - first.began), max(first.done, second.done) - first.began
        if took > most + EDGE:
            hint = ("`sweep` needs the corridor only, and `load` the lift only: neither has to wait for the "
                    "other, not for a lock, not for a group, and not for a thread.")  # fmt: skip
            if in_turns:
                hint = "The two need both places, so one waits for the other's drives, and for nothing else."
            both = f"{first.name} and {second.name}"
            raise Missed(f"{both} done within {most:.2g} s", f"after {took:.2g} s", hint, picture="topics")


def _stays(drives: list[JobDrive]) -> Iterator[JobDrive]:
    """The drives, each until the job's next one: until then the job stays where it is."""
    for drive in drives:
        begins = [later.begin for later in drives if later.job == drive.job]
        yield drive._replace(end=min((b for b in begins if b >= drive.end - EDGE), default=drive.end))


def _report(run: Recording, name: str, row: Message) -> str:
    """Return the report of a job: its name, its number, and for a load the weight that /scale responded."""
    if name != LOAD:
        return f"{name} {row.message.data}"
    calls = [call for call in run.calls_of(SCALE) if call.response is not None]
    weights = [f"{call.response.sum}" for call in calls if call.request.a == row.message.data]
    return " ".join([name, f"{row.message.data}", *(weights[:1] or ["WEIGHT"])])


def _drives(run: Recording) -> Iterator[JobDrive]:
    """The drives that were published on /places, each when it has ended."""
    begun: dict[tuple[str, str], Seconds] = {}
    for row in from_student(run, PLACES):
        job, what, places = [*row.message.data.split(maxsplit=2), "", "", ""][:3]
        if what == "enters":
            begun[job, places] = row.stamp
        elif (job, places) in begun:
            yield JobDrive(job, places, begun.pop((job, places)), row.stamp)
