"""The project: a robot of several programs that delivers, whatever happens in its warehouse."""

import functools
from typing import Any

from grader.checks import Missed, nearest_person, shift, traveled
from grader.checks.check import Hints
from grader.checks.motion import after_a_touch, stood_still, world_in
from grader.checks.shift import Job
from grader.diagnosis.driving import still_obeyed
from grader.exercise import Exercise, Scenario
from grader.exercises.delivery.deliver.questions import questions
from grader.exercises.delivery.deliver.robot_programs import SHIFT, programs, shift_of
from grader.responses import Window, top_speed
from grader.worlds.warehouses import FAIR, warehouse
from sim.evidence import Recording
from sim.ros.launching.respawned import respawned

__all__ = ["deliver", "programs", "questions", "shift_of"]

LONGEST = 300.0  # s of the other runs; their one order takes 35 to 250
ENOUGH = 2  # orders of a shift; who does the work well often delivers three
GIVEN_UP = 60.0  # s for which a robot stands that has an order; people stop it for 40 at most
DRIVING, CLOSE = 0.1, 0.5  # m/s; m from the robot's middle to a person: who waits for people is 1 m away
SETTLING, STANDING = 1.0, 0.02  # s from the last scan until the robot stands; m/s
IDLE = {
    "None of your programs publishes on /cmd_vel. Are all of them in your list?":
        lambda run: all(row.from_course for row in run.messages("/cmd_vel")),
    "The robot never moves. Run each program alone, and look at what it publishes, and when.":
        lambda run: traveled(run) < 0.1,
    "{touch}": lambda run: run.contacts and {"touch": after_a_touch(run)},
}
"""The usual reasons for a robot that doesn't deliver at all."""


def _unless_idle(hint: str) -> Hints:
    """A table of hints: the usual reasons, and otherwise what the scenario is about."""
    return {**IDLE, hint: lambda run: True}


def _met(run: Recording) -> bool:
    """A person was touched."""
    return any(contact.what == "person" for contact in run.contacts[-1:])


def _over(run: Recording) -> bool:
    """An order was delivered, a person was touched, or the robot stands for good."""
    orders = [row.message for row in run.messages("/orders")[-1:] if row.from_course]
    delivered = any(order.status == order.DELIVERED for order in orders)
    return delivered or _met(run) or stood_still(run, GIVEN_UP)


def _scenario(kind: str, seed: int, prepare: Any = None) -> Scenario:
    until = _met if kind == "shift" else _over
    seconds = SHIFT if kind == "shift" else LONGEST
    world = functools.partial(warehouse, kind)
    about = {"prepare": prepare, "name": kind, "fair": FAIR[kind], "any_order": kind != "shift"}
    return Scenario(world, seconds, seed, until=until, **about)


deliver = Exercise(
    "deliver",
    "The delivery robot",
    scenarios=[
        _scenario("shift", 3),
        _scenario("blind", 11),
        _scenario("blocked", 6),
        _scenario("canceled", 7),
        # Every program is killed between 5 and 12 s, each at another moment, and is back 2 s later.
        _scenario("restarted", 8, functools.partial(respawned, 5.0, 12.0, 2.0)),
    ],
)


@deliver.check(1, lasts=True)
def touches_no_one(run: Recording) -> None:
    """In no run does the robot touch a person, or drive within 0.5 m of one: that run earns no more."""
    moment, near = shift(run).met_person, nearest_person(run, DRIVING)
    if moment is not None:
        hint = ("Control must stop while a person walks nearby, whatever its goal, and also while it "
                "doesn't know. The replay shows what it did before the contact.")
        raise Missed("no contact with a person", f"one at {moment:.3g} s", hint, picture="path", unsafe=True)
    if near is not None and near.away < CLOSE:
        saw = f"{near.speed:.2f} m/s at {near.stamp:.3g} s, {near.away:.2f} m from a person"
        hint = ("Only by luck was no one hurt. Does perception publish people who walk, and does control "
                "check every time?")
        raise Missed(f"a robot that stands still within {CLOSE} m", saw, hint, picture="path", unsafe=True)


@deliver.check(5, after=touches_no_one, only="shift", hints=IDLE)
def delivers(run: Recording) -> None:
    """In a shift of 150 s at least two orders are delivered."""
    done = shift(run)
    count = len(done.delivered)
    if count < ENOUGH:
        saw = f"{count} of {len(done.jobs)}"
        credit = 0.8 * count / ENOUGH
        raise Missed(f"{ENOUGH} delivered orders", saw, credit=credit, picture="path")


@deliver.check(2, after=delivers, only="shift")
def charges(run: Recording) -> None:
    """The battery never runs empty, although it starts at 20 %."""
    empty = next((stamp for stamp, share in shift(run).battery if share <= 0.0), None)
    if empty is not None:
        hint = "Below a third, drive to /dock_pose, and stay there until the battery is nearly full."
        raise Missed("a battery that is charged in time", f"it is empty at {empty:.0f} s", hint)


@deliver.check(1, after=delivers, only="shift")
def touches_nothing(run: Recording) -> None:
    """In the shift the robot touches no shelf, no wall and no box."""
    touched = shift(run).touched
    if touched:
        saw = ", ".join(f"{what}: {count}" for what, count in touched.items())
        hint = "Keep the robot's center 0.2 m away from the map's walls and from what the lidar sees."
        raise Missed("no contact", saw, hint, picture="path")


@deliver.check(3, after=touches_no_one, only="blind", hints=IDLE)
def stands_blind(run: Recording) -> None:
    """Whenever the lidar falls silent, the robot stops within 1 s."""
    drove = False
    for begin, end in world_in(run).lidar.silent:
        if begin + SETTLING > run.stamp:
            break
        before, silent = Window(begin - SETTLING, begin), Window(begin + SETTLING, end)
        drove |= top_speed(before.rows(run.path)).linear > STANDING
        top = top_speed(silent.rows(run.path))
        if top.linear > STANDING:
            expected = f"the robot standing still from {begin + SETTLING:.3g} to {end:.3g} s: no scans arrive"
            hint = ("How old is the data that control uses? If it is over half a second old, publish zeros. "
                    "Compare header.stamp.")
            saw = f"{top.linear:.2f} m/s at {top.stamp:.3g} s"
            raise Missed(expected, saw, hint, picture="topics", unsafe=True)
        if silence := still_obeyed(run, min(end, run.stamp) - SETTLING):
            saw = "no zeros: other robots would drive on"
            raise Missed("zeros while no scans arrive", saw, silence, picture="topics", unsafe=True)
    if not drove and not _delivers(run):  # a robot that delivers may stand for people
        raise Missed("a robot that drives when the lidar falls silent", "it was already standing still")


WAITS_FOR_EVER = "The scans are back, and poses and plans should be, too: nothing may wait forever."
SAME_WAY = "Plan again once a second, and treat what the lidar sees as a wall."
SAME_ORDER = "A canceled order is published once more, with that status. Then choose again."
NEW_MESSAGES_ONLY = ("A restarted program receives old orders, the map and the dock only if it requests "
                     "durability TRANSIENT_LOCAL. And data that hasn't arrived yet must not crash "
                     "it.")


@deliver.check(1, after=stands_blind, only="blind", hints=_unless_idle(WAITS_FOR_EVER))
def sees_again(run: Recording) -> None:
    """When the scans return, it continues and delivers the order."""
    _require_delivery(run)


@deliver.check(3, after=touches_no_one, only="blocked", hints=_unless_idle(SAME_WAY))
def goes_round(run: Recording) -> None:
    """When a box that is on no map blocks its path, it finds another path, and delivers the order."""
    _require_delivery(run)


@deliver.check(2, after=touches_no_one, only="canceled", hints=_unless_idle(SAME_ORDER))
def takes_another(run: Recording) -> None:
    """When its order is canceled on the way, it carries out another one."""
    _require_delivery(run)


@deliver.check(2, after=touches_no_one, only="restarted", hints=_unless_idle(NEW_MESSAGES_ONLY))
def comes_back(run: Recording) -> None:
    """Each program is killed once, and restarted 2 s later: the order is still delivered."""
    _require_delivery(run)


def _require_delivery(run: Recording) -> None:
    if not _delivers(run):
        saw = "; ".join([f"after {run.stamp:.0f} s", *map(_text, shift(run).jobs)])
        raise Missed("a delivered order", saw, picture="path")


def _delivers(run: Recording) -> bool:
    return any(job.status == "delivered" for job in shift(run).jobs)


def _text(job: Job) -> str:
    if job.over is None and job.picked_up is not None:
        return f"order {job.id} was picked up at {job.picked_up:.0f} s and not delivered"
    if job.over is not None:
        return f"order {job.id} was {job.status} at {job.over:.0f} s"
    return f"order {job.id} is {job.status}"
