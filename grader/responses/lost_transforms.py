"""A robot whose transforms end: no news is bad news."""

from typing import Any

from grader.checks.check import Missed
from grader.checks.motion import traveled
from grader.responses.speeds import require_standing
from grader.responses.stimuli import from_course
from grader.responses.window import Window
from sim.evidence import Recording

BEFORE, SOME = 2.0, 0.1  # s; m that the robot drives in that time
STOPPED = 1.5  # s; half a second until a transform is old, the time of a timer, and braking
HINT = (
    "Time() is the newest time that is known, however old: the lookup goes on succeeding for 10 s. "
    "Compare the stamp of what it returns with the clock; where it is older than 0.5 s, send zeros."
)


def stands_without_transforms(run: Recording, child: str, what: str, first: str) -> None:
    """Raise Missed unless the robot drives, and stands still from 1.5 s after a frame's last transform on.

    child: the frame, which a program of the course publishes. what: completes "after the last transform".
    first: the hint where the robot doesn't drive before.
    """
    last = max(row.stamp for row in from_course(run, "/tf") if _has(row.message, child))
    if traveled(run.during(last - BEFORE, last)) < SOME:
        raise Missed(f"a robot that drives until {last:.3g} s", "one that stands still", first)
    why = f"{STOPPED:g} s after the last transform {what}, at {last:.3g} s"
    require_standing(run, Window(last + STOPPED, run.ended.stamp), why, HINT)


def _has(message: Any, child: str) -> bool:
    return any(transform.child_frame_id == child for transform in message.transforms)
