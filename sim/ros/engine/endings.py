"""Why a run ended, in a sentence for the student."""

from __future__ import annotations

from typing import Any

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.client import Client
from rclpy.timer import Rate

from sim.evidence import Ended
from sim.nanoseconds import SECOND
from sim.ros.engine.awaits import useless_await
from sim.ros.engine.engine import Engine
from sim.ros.fibers.fiber import Fiber
from sim.ros.recorder.records import CLIENT
from sim.ros.recorder.running import RunningCallback
from sim.ros.recorder.tracebacks import student_line

AFTER_RETURN = "can only be handled in the same callback group, after it has returned."
_SLEEPS_AT_RATE = "the timer of the Rate, which needs the thread that waits"
BLOCKED_AFTER = SECOND  # of waiting; until then a callback is just slow


def conclusion(engine: Engine, over: int | None) -> Ended:
    """Return how a run without a hang ended. over: when the last program had ended, or None."""
    now, errors = engine.recorder.now, engine.recording.errors
    if errors:
        first = errors[0]
        return Ended("error", now, f"{first.callback} of {first.node} raised {first.type}{first.says}")
    if over is not None:
        return Ended("finished", now, f"Every program had ended by t = {over / SECOND:g} s.")
    peer = engine.transport.peer
    waiting = blocked(engine) or ("" if peer is None else peer.blocked)
    if waiting:
        return Ended("blocked", now, waiting)
    return Ended("time", now, f"All {now:g} s were run.")


def blocked(engine: Engine) -> str | None:
    """Return which callback waits for something that can't happen, in a sentence; None if none does."""
    executors = [waiter.executor for waiter in engine.waiters.all]
    return (
        _blocked_call(engine)
        or _blocked_coroutine(engine)
        or useless_await(executors, engine.now, BLOCKED_AFTER, engine.recorder.name_of)
    )


def _blocked_call(engine: Engine) -> str | None:
    """A callback on the stack of a fiber that waits forever."""
    for fiber in engine.fibers:
        running = fiber.callbacks[-1] if fiber.callbacks else None
        if running is None or fiber.wake_at is not None or engine.now - running.began < BLOCKED_AFTER:
            continue
        where = student_line(fiber.greenlet.gr_frame)
        return f"{_since(running)}{where}. {_why(engine, fiber, running)}"
    return None


def _since(running: RunningCallback) -> str:
    since = running.began / SECOND
    return f"{running.name} of node {running.node} has waited since t = {since:g} s and never returned"


def _why(engine: Engine, fiber: Fiber, running: RunningCallback) -> str:
    waited = _pending(engine, running)
    if not waited:
        return f"It waits for {_SLEEPS_AT_RATE if _sleeps_at_rate(fiber) else fiber.waits_for}."
    if (
        isinstance(running.group, MutuallyExclusiveCallbackGroup)
        and waited[0].callback_group is running.group
    ):
        return f"{_response_to(waited[0])} {AFTER_RETURN}"
    return f"{_response_to(waited[0])} can only be handled by the thread that waits for it."


def _sleeps_at_rate(fiber: Fiber) -> bool:
    frame = fiber.greenlet.gr_frame
    while frame is not None and frame.f_code is not Rate.sleep.__code__:
        frame = frame.f_back
    return frame is not None


def _blocked_coroutine(engine: Engine) -> str | None:
    """A suspended callback whose response its own callback group excludes."""
    for running in engine.callbacks.suspended:
        exclusive = isinstance(running.group, MutuallyExclusiveCallbackGroup)
        if not exclusive or engine.now - running.began < BLOCKED_AFTER:
            continue
        for client in _pending(engine, running):
            if client.callback_group is running.group:
                return f"{_since(running)}. {_response_to(client)} {AFTER_RETURN}"
    return None


def _pending(engine: Engine, running: RunningCallback) -> list[Any]:
    """Clients of the callback's node with a request that has no response yet."""
    nodes = [n for p in engine.programs for n in p.nodes if engine.recorder.name_of(n) == running.node]
    clients = [c for node in nodes for c in node.clients if c._pending_requests]
    waitables = [w for node in nodes for w in node.waitables]
    names = ("_pending_goal_requests", "_pending_result_requests", "_pending_cancel_requests")
    return clients + [w for w in waitables if any(getattr(w, name, None) for name in names)]


def _response_to(client: Any) -> str:
    if isinstance(client, Client):
        return f"The response of service {CLIENT.of(client).service}"
    return f"The response of action {client._action_name}"
