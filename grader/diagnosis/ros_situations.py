"""Advice on errors of lifecycle nodes, coroutines and parameters, by what else the recording has."""

from __future__ import annotations

import re

from sim.evidence import CallbackError, Recording

_TRANSITIONS = {
    0: "create", 1: "configure", 2: "cleanup", 3: "activate", 4: "deactivate",
    5: "shutdown", 6: "shutdown", 7: "shutdown", 8: "destroy",
}  # fmt: skip
_POSSIBLE = {
    "unconfigured": "configure or shutdown",
    "inactive": "activate, cleanup or shutdown",
    "active": "deactivate or shutdown",
    "finalized": "nothing any more",
}
_NO_TRANSITION = re.compile(r"No transition matching (\d+) found for current state (\w+)")
_METHOD = re.compile(r", in (on_(?:configure|cleanup|activate|deactivate|shutdown))\n")
_RAISED = re.compile(r"\n\s+raise \w.*\n[^\n]*\n?$")


def invalid_transition(error: CallbackError, recording: Recording) -> str:
    """A transition that a lifecycle node does not have in its state."""
    found = _NO_TRANSITION.findall(recording.stderr)
    if "Transition is not registered" not in error.text or not found:
        return ""
    number, state = found[-1]
    name = _TRANSITIONS.get(int(number), f"with the number {number}")
    return (
        f"{error.node} is {state}, and a lifecycle node has no transition {name} in this state "
        f"(possible: {_POSSIBLE.get(state, 'nothing')}). Read the state first (`ros2 lifecycle get "
        f"{error.node}`, or the service get_state), and go through the states in order: configure, activate, "
        "deactivate, cleanup. rclpy does not refuse a wrong request: it raises an exception, and the node "
        "dies."
    )


def raising_transition(error: CallbackError) -> str:
    """An exception raised on purpose in a transition's method, to let the transition fail."""
    method = _METHOD.search(error.traceback)
    if not method or not _RAISED.search(error.traceback):
        return ""
    return (
        f"An exception in {method[1]} ends the transition with ERROR, and rclpy doesn't log it. If a "
        "transition can't be made, log the reason, and return TransitionCallbackReturn.FAILURE."
    )


def asyncio_pause(error: CallbackError) -> str:
    """asyncio.sleep awaited in a callback."""
    if error.text != "no running event loop" or "asyncio.sleep" not in error.traceback:
        return ""
    return (
        "`asyncio.sleep()` works only in asyncio's event loop, and a callback that is a coroutine runs in "
        "rclpy's executor. For a pause, await a future that a timer completes: `pause = Future(); timer = "
        "self.create_timer(0.5, lambda: pause.set_result(None)); await pause; timer.cancel()`, with `from "
        "rclpy.task import Future`."
    )


def init_in_with(error: CallbackError) -> str:
    """rclpy.init() as a context manager, as the tutorials of later distributions have it."""
    if error.type != "TypeError" or not re.search(r"\n\s+with (rclpy\.)?init\(", error.traceback):
        return ""
    return (
        "`with rclpy.init():` is for ROS distributions after Jazzy: here rclpy.init() returns None. Call it "
        "alone, `rclpy.init(args=args)`, create and spin the node after it, and end with "
        "`rclpy.try_shutdown()`."
    )


def empty_list(error: CallbackError) -> str:
    """A list of text or numbers for a parameter whose default is an empty list."""
    wrong = re.search(r"'(.+)' to '(.*)' of type '(\w+)', expecting type 'BYTE_ARRAY'", error.text)
    return "" if wrong is None else empty_list_advice(wrong[1], wrong[3])


def empty_list_advice(name: str, given: str) -> str:
    """Return what to do about a parameter with the default `[]` that was given a list of another type."""
    return (
        f"The parameter `{name}` got a list of type {given}, but was declared with an empty list, which "
        "rclpy takes for a BYTE_ARRAY: `[]` doesn't show what is in the list. Declare the type: "
        f"`self.declare_parameter('{name}', Parameter.Type.{given})`, with `from rclpy.parameter import "
        "Parameter`; the parameter then has no value until it is set."
    )


def invalid_description(error: CallbackError, recording: Recording) -> str:
    """A URDF that robot_state_publisher can't read; its log says why."""
    if "Unable to initialize urdf::model" not in error.text:
        return ""
    lines = [line.text for line in recording.logs if line.level == "ERROR" and line.stamp <= error.stamp]
    return f"The robot's description can't be read: {lines[-1].rstrip('.')}." if lines else ""
