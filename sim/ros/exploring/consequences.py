"""What follows in an order in which nodes fail: threads that stop, goals, calls, and the first error."""

from __future__ import annotations

import linecache
from collections.abc import Iterator, Sequence

from sim.evidence import CallbackError, Goal, Recording
from sim.evidence.failure import STUCK, frames_of

SILENT = 0.2  # of a run, without a callback that runs until the end in the usual order
ENDS = {
    "succeeded": "succeeds",
    "canceled": "is canceled",
    "aborted": "is aborted",
    "rejected": "is rejected",
}


def consequences(usual: Recording, failed: Recording, stopped: Sequence[str] = ()) -> str:
    """Return what goes another way than in the usual order, in sentences.

    stopped: threads that waited forever, such as
        "thread A.work of A still waits at line 7: `lock.acquire()`".
    """
    known = {(error.callback, error.type, error.text) for error in usual.errors}
    errors = (error for error in failed.errors if (error.callback, error.type, error.text) not in known)
    found = list(_stuck(usual, failed)) or list(stopped)
    found += [*_goals(usual, failed), *_calls(usual, failed)]
    found += [_failure(error) for error in errors][:1] or ([] if found else _silent(usual, failed))
    return " ".join(f"Then {text}." for text in found)


def _failure(error: CallbackError) -> str:
    frames = frames_of(error)
    place = f", at {_line(*frames[-1][:2])}" if frames else ""
    return f"`{error.callback}` fails at {error.stamp:.4g} s{place}: {error.type}{error.says}"


def _line(file: str, number: str) -> str:
    source = linecache.getline(file, int(number)).strip()
    return f"line {number}: `{source}`" if source else f"line {number}"


def _stuck(usual: Recording, failed: Recording) -> Iterator[str]:
    if failed.ended.reason in STUCK and failed.ended.reason != usual.ended.reason:
        yield failed.ended.detail.rstrip(".")


def _goals(usual: Recording, failed: Recording) -> Iterator[str]:
    for there, here in zip(usual.goals, failed.goals, strict=False):
        if there.status != here.status:
            yield f"the goal of {here.action} {_end(here)}; in the usual order it {_end(there)}"


def _end(goal: Goal) -> str:
    return f"{ENDS.get(goal.status, goal.status)} at {goal.ended:.4g} s" if goal.over else "never ends"


def _calls(usual: Recording, failed: Recording) -> Iterator[str]:
    for there, here in zip(usual.calls, failed.calls, strict=False):
        if there.received is not None and here.received is None:
            yield f"{here.client}, which calls {here.service}, never gets a response"


def _silent(usual: Recording, failed: Recording) -> Iterator[str]:
    """The callbacks that run until the end in the usual order, and not in the other one."""
    last = [{(run.node, run.callback): run.stamp for run in each.callbacks} for each in (usual, failed)]
    for callback, stamp in last[0].items():
        if last[1].get(callback, 0.0) < stamp - SILENT * usual.stamp:
            after = f" that begins after {last[1][callback]:.4g} s" if callback in last[1] else ""
            yield f"no call of `{callback[1]}` of {callback[0]}{after} returns"
