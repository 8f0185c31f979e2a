"""Measures over what the nodes log."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from typing import NamedTuple

from grader.checks.check import Missed
from grader.checks.no_data import no_data
from grader.checks.work import worked_until
from grader.diagnosis.activity import slow_callback
from sim.evidence import LogLine, Message, Recording, Seconds
from sim.suggestions import closest_match, describe_text_difference

FLOOD = 10.0  # times as many answers as were asked for earn nothing


class LogMatch(NamedTuple):
    """A log line that a pattern was found in, and the texts of the pattern's groups."""

    stamp: Seconds
    level: str  # as in LogLine
    text: str
    groups: tuple[str, ...]


def logs(
    recording: Recording, pattern: str, *, level: str = "", at_least: int = 1, example: str = ""
) -> list[LogMatch]:
    """The log lines in which a regular expression is found (capital letters don't count).

    level: DEBUG, INFO, WARN, ERROR or FATAL; "" for any. example: such a line, for who reads no patterns.
    Raises Missed when there are fewer than `at_least`.
    """
    example = example or pattern
    texts = [
        LogMatch(line.stamp, line.level, line.text, match.groups())
        for line in recording.logs
        if not line.from_course and (match := re.search(pattern, line.text, re.IGNORECASE))
    ]
    found = [line for line in texts if level in ("", line.level)]
    if len(found) < at_least:
        many = "a log line" if at_least == 1 else f"{at_least} log lines"
        expected = f"{many}{f' at level {level}' if level else ''} like “{example}”"
        guess = "Compare the two lines. And is the method that should log it ever called?"
        saw, hint = _nearest(recording, pattern, example, texts, found, level)
        raise Missed(expected, saw, hint, guess=guess if recording.logs else "")
    return found


def _nearest(
    recording: Recording, pattern: str, example: str, texts: list[LogMatch], found: list[LogMatch], level: str
) -> tuple[str, str]:
    """Return what was seen instead, and a hint."""
    if found:
        return f"{len(found)}; the last at {found[-1].stamp:.3g} s", ""
    if texts:
        method = {"WARN": "warning"}.get(level, level.lower())
        return f"“{texts[0].text}” at level {texts[0].level}", f"Use self.get_logger().{method}(...)."
    printed = next((text for _, text in recording.prints if re.search(pattern, text, re.IGNORECASE)), "")
    if printed:
        return f"“{printed.strip()}”, printed", "Use self.get_logger().info(...) instead of print(...)."
    unfilled = next((line.text for line in recording.logs if re.search(r"\{\w[^}]*\}", line.text)), "")
    if unfilled:
        return f"“{unfilled}”", 'Put an f before the quotes: f"..." inserts what is in braces.'
    similar = _most_similar(recording, example)
    if similar:
        return f"“{similar}”", describe_text_difference(similar, example)
    if recording.logs:
        return f"no such line; the first line is “{recording.logs[0].text}”", ""
    return "no log line at all", ""


def _most_similar(recording: Recording, example: str) -> str:
    folded = {line.text.casefold(): line.text for line in reversed(recording.logs)}
    return folded.get(closest_match(example.casefold(), folded, 0.7), "")


def come_every(
    recording: Recording, lines: list[LogMatch], period: Seconds, *, credit: float = 0.0
) -> list[LogMatch]:
    """The lines, which come one by one from the start of the run to its end, at the pace of a timer.

    credit: what is earned by the lines alone; checks that come after this one are handed them all the same.
    Raises Missed with their real pace.
    """
    stamps = [line.stamp for line in lines]
    gaps = [after - before for before, after in itertools.pairwise(stamps)]
    if gaps and all(abs(gap - period) <= 0.1 * period for gap in gaps):
        late = stamps[0] - max(recording.begin, recording.started_at) > 1.6 * period
        if not late and worked_until(recording) - stamps[-1] <= 1.6 * period:
            _set_by_a_timer(recording, period, credit, lines)
            return lines
        hint = f"What changes at {stamps[0] if late else stamps[-1]:.3g} s?"
    elif recording.graph.timers:
        hint = (
            "Let one timer set the pace, with its period in seconds. Log one line each time its method is "
            "called."
        )
    else:
        hint = "The node has no timer: create_timer(period, method) calls a method again and again."
    if len(stamps) > FLOOD * (worked_until(recording) - recording.begin) / period:
        credit = 0.0
    expected = f"a line every {period:g} s, from start to end"
    hint = slow_callback(recording) or hint
    raise Missed(expected, _pace(stamps, gaps), hint, credit=credit, measured=lines)


def _set_by_a_timer(recording: Recording, period: Seconds, credit: float, lines: list[LogMatch]) -> None:
    if all(timer.node in recording.course_nodes for timer in recording.graph.timers):
        hint = (
            "While a loop in the node sleeps, the node receives and answers nothing: "
            f"create_timer({period:g}, method) calls a method again and again, and leaves the node free."
        )
        saw = f"a line every {period:g} s, but no timer"
        raise Missed("a timer that sets the pace", saw, hint, credit=credit, measured=lines)


def _pace(stamps: list[Seconds], gaps: list[Seconds]) -> str:
    if not stamps:
        return "no line"
    if not gaps:
        return f"one line, at {stamps[0]:.3g} s"
    if max(gaps) < 1e-6:
        return f"{len(stamps)} lines at once, at {stamps[0]:.3g} s"
    if min(gaps) < 1e-6:
        return f"lines that come at the same moment, then a pause of {max(gaps):.3g} s"
    if max(gaps) - min(gaps) > 1e-6:
        return f"pauses between {min(gaps):.3g} s and {max(gaps):.3g} s"
    return f"a line every {gaps[0]:.3g} s, from {stamps[0]:.3g} s to {stamps[-1]:.3g} s"


def answers(
    recording: Recording,
    topic: str,
    pattern: str | Callable[[Message], str] = "",
    *,
    level: str = "",
    within: Seconds = 0.5,
    where: Callable[[Message], bool] = lambda received: True,
    what: str = "",
    only: bool = False,
) -> None:
    """Every message on a topic is answered by a log line soon after; partial credit for the part that is.

    pattern: regular expression, or a function that gives one for each message.
    where: picks the messages that want an answer. what: what these are, such as "levels below 20 %".
    only: and none of the student's lines at this level comes after a message that wants no answer.
    Raises Missed for the first message without an answer, and as `no_data` when there is none to answer.
    """
    received = recording.messages(topic)
    asked = [one for one in received if where(one)]
    if not asked:
        saw = f"none among the {len(received)} on {topic}" if received else "none"
        wanted = what or f"messages on {topic} that want a log line"
        raise no_data(recording, wanted, saw, recording.graph.publishers(topic))
    text = pattern if callable(pattern) else lambda received: pattern
    open_ = [one for one in asked if not _lines_after(recording, one.stamp, within, text(one), level)]
    at_level = f" at level {level}" if level else ""
    if open_:
        like = f" like “{text(open_[0])}”" if pattern else ""
        each = f"of the {what}" if what else f"message on {topic}"
        expected = f"a log line{at_level}{like} after each {each}"
        right = 1 - len(open_) / len(asked)
        credit = right if right >= 0.5 else 0.0  # a few may be right by chance
        raise Missed(expected, _instead(recording, open_[0], within), credit=credit)
    if only:
        _no_others(recording, received, where, level, f"no other log line{at_level}")


def _no_others(
    recording: Recording, received: list[Message], where: Callable[[Message], bool], level: str, expected: str
) -> None:
    """The student's lines at this level come after messages that want one; else raises Missed."""

    def answers_one(line: LogLine) -> bool:
        before = [one for one in received if one.stamp <= line.stamp]
        return bool(before) and where(before[-1])

    lines = [line for line in recording.logs if level in ("", line.level) and not line.from_course]
    others = [line for line in lines if not answers_one(line)]
    if others:
        saw = f"“{others[0].text}” at {others[0].stamp:.3g} s"
        raise Missed(expected, saw, credit=1 - len(others) / len(lines))


def _lines_after(recording: Recording, stamp: Seconds, within: Seconds, pattern: str, level: str) -> bool:
    return any(
        stamp <= line.stamp < stamp + within
        and level in ("", line.level)
        and not line.from_course
        and re.search(pattern, line.text, re.IGNORECASE)
        for line in recording.logs
    )


def _instead(recording: Recording, received: Message, within: Seconds) -> str:
    near = [line for line in recording.logs if received.stamp <= line.stamp < received.stamp + within]
    said = f"“{near[0].text}” ({near[0].level})" if near else "no line"
    return f"{said} within {within:g} s of the message at {received.stamp:.3g} s"
