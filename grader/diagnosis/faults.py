"""Errors, hangs and early ends of a student's code, as a Fault."""

from __future__ import annotations

import linecache
import re

from grader.diagnosis.error_advice import advice
from grader.diagnosis.fault import NOT_STARTED, Fault
from grader.diagnosis.other_types import words_of
from grader.diagnosis.situations import advice_here
from sim.evidence import CallbackError, Ended, Recording, first_error, first_line, place_of

_THREAD = "thread "
_RAISES = "raise NotImplementedError"
# rclpy's own NotImplementedError, for SetBool() and Spin(), and that of a run for what it can't do: they
# are no exercise that is not started.
_NOT_FROM_STUDENT = re.compile(
    r"classes can not be instantiated|can't (run in|change the time in a run|be)\b.* simulated (time|there)"
)
_HINTS = {
    "error": "",
    "hang": "Look there for a loop that never ends (`while True:` without a way out), or a wait for "
            "something that never happens. A callback should do one small step and return.",
    "livelock": "Callbacks trigger each other without any time passing: two nodes that answer each other's "
                "every message, or a timer with a period of 0. Let a timer with a period set the pace.",
    "blocked": "Everything waits for something that can't happen. Inside a callback, don't wait for another "
               "callback of the same node (spin_until_future_complete, client.call): use call_async and "
               "add_done_callback, or await.",
}
_AWAITS = (
    "A callback that awaits occupies its callback group until it has returned, and a response is handled in "
    "the client's group. Give the client a group of its own: `callback_group=ReentrantCallbackGroup()`, with "
    "`from rclpy.callback_groups import ReentrantCallbackGroup`."
)
_IN_ITS_GROUP = (
    "A callback that awaits occupies its callback group until it has returned. Give the timer or "
    "subscription that completes the future a group of its own: `callback_group=ReentrantCallbackGroup()`, "
    "with `from rclpy.callback_groups import ReentrantCallbackGroup`."
)
_NOT_COMPLETED = (
    "A future is complete once some code has called `future.set_result(value)` on it: a callback of another "
    "callback group, or another thread. Without one, let a timer or a subscription do the next step."
)
_RATE = (
    "A Rate is a timer of the node: sleep() returns when the thread that spins the node runs its callback, "
    "so it can't be called in a callback of that thread. Let a timer do the next step, or sleep in another "
    "thread."
)
_LOCK = (
    "That lock is never released: this thread holds it already, or another one that itself waits for a lock "
    "of this thread. Take several locks in the same order everywhere, and hold none while you wait for "
    "something else."
)
_MAIN_HANGS = (
    "A main() that loops by itself lets no callback run. To keep a node alive, and let its timers and "
    "subscriptions work, end main() with rclpy.spin(node): it returns only at shutdown."
)
_FLOOD = (
    "A loop publishes again and again without any time passing: let a timer set the pace, or pause in each "
    "iteration."
)
_WAITS_OUTSIDE = (
    "Simulated time stands still during such a wait, so a run has a limit for it. Let the other program take "
    "part in the run, as in run(A, B), or start this one in a terminal."
)


def find_fault(recording: Recording) -> Fault | None:
    """The student's first error, or the way the run got stuck; None when it ran as it should."""
    error = first_error(recording)
    if error is not None:
        return _from_error(error, recording)
    ended = recording.ended
    return _from_end(ended) if ended.reason in _HINTS else None


def _from_error(error: CallbackError, recording: Recording) -> Fault:
    if error.type == "NotImplementedError" and not _NOT_FROM_STUDENT.search(error.text):
        if _is_left_over(error):
            return Fault(
                expected="no `raise NotImplementedError` after your code",
                saw=f"Your code is ended by a `raise NotImplementedError` ({place_of(error)})",
                hint="Delete the line that raises, and run this cell again.",
                before_start=error.stamp <= 0.0,
            )
        text = error.text.strip() or "there is still a `raise NotImplementedError` in the code"
        return Fault(
            expected="your own code instead of `raise NotImplementedError`",
            saw=f"This exercise is not started yet: {text}",
            hint="Write your code, delete the line that raises, and run this cell again.",
            before_start=True,
            sentence=NOT_STARTED,
        )
    return Fault(
        expected="no error",
        saw=f"{error.type}: {_first_line(error, recording)} ({place_of(error)})",
        hint=advice_here(error, recording) or advice(error),
        # A thread that crashes at once takes nothing along: main() and its nodes go on.
        before_start=error.stamp <= 0.0 and not error.callback.startswith(_THREAD),
    )


def _is_left_over(error: CallbackError) -> bool:
    """Return whether there is code above the line that raised, not the comment of an unstarted exercise."""
    places = re.findall(r'File "([^"]+)", line (\d+), in ', error.traceback)
    if not places:
        return False
    file, line = places[-1]
    above = [text.strip() for text in linecache.getlines(file)[: int(line) - 1] if text.strip()]
    is_code = bool(above) and not above[-1].startswith(("#", '"', "def ", "class "))
    return is_code and _RAISES in error.traceback


def _from_end(ended: Ended) -> Fault:
    hint = _HINTS[ended.reason]
    if " messages at " in ended.detail:
        hint = _FLOOD
    elif re.search(" of real time for | in a call that simulated time can't shorten", ended.detail):
        hint = _WAITS_OUTSIDE
    elif "and never returned. The response of " in ended.detail:  # with a line, it waits without `await`
        hint = _AWAITS
    elif ended.detail.endswith("It waits for a lock."):
        hint = _LOCK
    elif "the timer of the Rate" in ended.detail:
        hint = _RATE
    elif "It awaits a future that only " in ended.detail:
        hint = _IN_ITS_GROUP
    elif "It awaits a future that no code completes" in ended.detail:
        hint = _NOT_COMPLETED
    elif ended.reason == "hang" and re.match(r"[a-z_]\w*\(\) at t = \S+ s computed", ended.detail):
        hint = _MAIN_HANGS
    return Fault(expected="a run to the end", saw=ended.detail, hint=hint, before_start=ended.stamp <= 0.0)


def _first_line(error: CallbackError, recording: Recording) -> str:
    return first_line(words_of(error, recording), error.type)
