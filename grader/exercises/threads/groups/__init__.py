"""Callback groups as a contract: a control loop on time beside a slow planner, and one consistent state."""

from __future__ import annotations

import itertools
import math
import statistics
from typing import NamedTuple

from geometry_msgs.msg import Twist

from grader.checks import Missed, keeps_deadline, otherwise, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.threads.groups.tank_site import LOAD, RADIUS, tank_site
from grader.geometry.near import is_near
from grader.responses import EDGE, from_course, from_student, listed
from sim.evidence import Message, Recording, Seconds

__all__ = ["groups", "tank_site"]

COMMANDS, PLANS = "/cmd_vel", "/plan"
STEPS, STEP = 3, 0.08  # how often a plan is improved, and how long that takes (s)
DEADLINE = 0.33  # s after the radius, for the last plan
FRESH = 0.12  # s: how old a load may be when a step begins
SETTLED = 0.06  # s after which a plan must be driven
PERIOD, LATE = 0.02, 0.035  # s
BEGIN = 0.06  # s: from when on the loop is judged
HALF_DONE = 0.035  # s: a mixture that lasts longer isn't due to two statements
SECONDS, ORDERS = 0.42, 32  # s, and the number of runs: each has another order

# The course's programs and the student's begin together, so that a plan is ready at the moment of a loop.
groups = Exercise("groups", "Slow work beside a fast loop", seconds=SECONDS, companions=tank_site,
                  seeds=tuple(range(1, ORDERS + 1)), waits=False)  # fmt: skip

WAITS = ("The loop waits while a plan is being made. Is the planner in another group, has the executor a "
         "second thread, and does the planner hold no lock while it calls find_speed and find_turn?")
OLD_LOAD = ("Each step uses the newest load: copy it when the step begins. And on_load must be able to run "
            "while your planner works.")  # fmt: skip
TWO_LOADS = ("That plan is made of two loads: /load arrives while your planner works. Copy left and right "
             "once in each step, and in such a way that no load can arrive in between.")  # fmt: skip


class TankPlan(NamedTuple):
    """A speed (m/s) and a turn rate (rad/s) that belong together."""

    speed: float
    turn: float

    @classmethod
    def of(cls, message: Twist) -> TankPlan:
        """Return the plan in a message."""
        return cls(message.linear.x, message.angular.z)

    def is_same(self, other: TankPlan) -> bool:
        """Return whether both numbers are the same."""
        return is_near(self.speed, other.speed, 1e-6) and is_near(self.turn, other.turn, 1e-6)

    def __str__(self) -> str:
        return f"linear.x={self.speed:.5f}, angular.z={self.turn:.5f}"


STANDING = TankPlan(0.0, 0.0)


@groups.check(1)
def has_its_topics(run: Recording) -> None:
    """The node subscribes to /load and /radius, and publishes Twist messages on /cmd_vel and /plan."""
    subscribes(run, LOAD, "geometry_msgs/msg/Vector3")
    subscribes(run, RADIUS, "std_msgs/msg/Float64")
    publishes(run, COMMANDS, "geometry_msgs/msg/Twist")
    publishes(run, PLANS, "geometry_msgs/msg/Twist")


@groups.check(3, after=has_its_topics, hints={
    "Nothing can plan so quickly: call find_speed and find_turn in each step.":
        lambda run, begin, stamps: any(stamp < begin + n * STEP - EDGE for n, stamp in enumerate(stamps, 1)),
    "Something holds the planner up: a sleep, a lock, or another callback of its group.":
        lambda run, begin, stamps: stamps[-1:] > [begin + DEADLINE],
    "Call find_speed and find_turn three times for a radius, and publish each plan on /plan, once.":
        otherwise,
})  # fmt: skip
def plans_three_times(run: Recording) -> None:
    """After a radius there are three plans on /plan, each 0.08 s of work, for the load of one moment."""
    (order,) = from_course(run, RADIUS)
    rows = from_student(run, PLANS)
    begin, stamps = order.stamp, [row.stamp for row in rows]
    early = any(stamp < begin + number * STEP - EDGE for number, stamp in enumerate(stamps, 1))
    if len(stamps) != STEPS or early or stamps[-1] > begin + DEADLINE:
        until = f"one each {STEP:g} s, until {begin + DEADLINE:.3g} s"
        expected = f"{STEPS} plans after the radius at {begin:.3g} s, {until}"
        saw = f"{len(rows)}, at {listed(stamps)} s" if rows else "none"
        raise Missed(expected, saw, about=(begin, stamps))
    for row in rows:
        _is_for_one_load(run, order.message.data, row)


@groups.check(4, after=plans_three_times, hints={
    "The loop runs while a plan is being made: store the plan only when both numbers are there.":
        lambda run, begin, end: end - begin >= HALF_DONE,
    "Between the two statements that store or read a plan, the other thread can run. Hold a lock while you "
    "copy, in both places, or store one object that has both numbers.":
        otherwise,
})  # fmt: skip
def drives_one_plan(run: Recording) -> None:
    """Each command on /cmd_vel is one whole plan, the newest one, and before the first plan zeros."""
    plans = [(row.stamp, TankPlan.of(row.message)) for row in from_student(run, PLANS)]
    rows = from_student(run, COMMANDS)
    for number, row in enumerate(rows):
        saw = TankPlan.of(row.message)
        known = [plan for stamp, plan in [(-1.0, STANDING), *plans] if stamp < row.stamp + SETTLED]
        settled = [plan for stamp, plan in plans if stamp < row.stamp - SETTLED]
        allowed = known[len(settled) :]
        if any(saw.is_same(plan) for plan in allowed):
            continue
        expected = f"{allowed[0]} on {COMMANDS} at {row.stamp:.4g} s"
        if any(saw.is_same(plan) for plan in known):
            raise Missed(expected, f"{saw}: an older plan", "Drive a plan as soon as it is published.")
        ends = (later.stamp for later in rows[number:] if not saw.is_same(TankPlan.of(later.message)))
        raise Missed(expected, f"{saw}{_mixture(saw, plans)}", about=(row.stamp, next(ends, run.ended.stamp)))


@groups.check(4, after=plans_three_times)
def is_on_time(run: Recording) -> None:
    """A command is due every 0.02 s, and none is more than 0.035 s late, also during planning."""
    stamps = [row.stamp for row in from_student(run, COMMANDS)]
    pauses = [after - before for before, after in itertools.pairwise(stamps)]
    always = len(pauses) > 0 and statistics.median(pauses) > PERIOD + LATE
    hint = "The timer's period is 0.02 s, all the time." if always else WAITS
    keeps_deadline(run, COMMANDS, PERIOD + LATE, hint=hint, begin=BEGIN)


def _is_for_one_load(run: Recording, radius: float, row: Message) -> None:
    """Raise Missed unless a plan is right for the load of one moment, at which its step began."""
    saw, loads, begin = TankPlan.of(row.message), run.received(LOAD), row.stamp - STEP
    fresh = [load.message for load in loads if begin - FRESH <= load.stamp <= begin + EDGE]
    right = [_plan(radius, load.x, load.y) for load in fresh]
    if any(saw.is_same(plan) for plan in right):
        return
    nearest = min(right, key=lambda plan: math.dist(plan, saw), default=STANDING)
    expected = f"{nearest} in the plan of {row.stamp:.4g} s, for the newest load"
    earlier = [load.message for load in loads if load.stamp <= row.stamp]
    if any(saw.is_same(_plan(radius, load.x, load.y)) for load in earlier):
        raise Missed(expected, f"{saw}: an older load", OLD_LOAD, credit=0.5)
    pairs = [(one.x, other.y) for one in earlier for other in earlier]
    speeds = [pair for pair in pairs if is_near(_plan(radius, *pair).speed, saw.speed, 1e-6)]
    turns = [pair for pair in pairs if is_near(_turn(radius, saw.speed, *pair), saw.turn, 1e-6)]
    if speeds and turns:
        raise Missed(expected, f"{saw}", TWO_LOADS, credit=0.5)
    hint = "Publish what find_speed returns as linear.x, and what find_turn returns as angular.z."
    raise Missed(expected, f"{saw}", hint)


def _plan(radius: float, left: float, right: float) -> TankPlan:
    """Return the plan for a radius (m) and the loads of the wheels (kg)."""
    speed = math.sqrt(9.81 * 0.2 * radius * min(left, right) / (left + right))
    return TankPlan(speed, _turn(radius, speed, left, right))


def _turn(radius: float, speed: float, left: float, right: float) -> float:
    return speed / radius * (1.0 + 0.1 * (right - left) / (left + right))


def _mixture(saw: TankPlan, plans: list[tuple[Seconds, TankPlan]]) -> str:
    """Return of which plans the numbers are, as text; "" if they are of none."""
    speeds = [stamp for stamp, plan in plans if is_near(plan.speed, saw.speed, 1e-6)]
    turns = [stamp for stamp, plan in plans if is_near(plan.turn, saw.turn, 1e-6)]
    texts = [f"the plan of {found[0]:.3g} s" if found else "no plan" for found in (speeds, turns)]
    return f": linear.x of {texts[0]}, angular.z of {texts[1]}" if texts[0] != texts[1] else ""
