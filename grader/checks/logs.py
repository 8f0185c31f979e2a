"""Measures over what the nodes log."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable

from grader.checks.check import Missed
from sim.recording import Heard, LogLine, Recording, Seconds


def logs(
    recording: Recording, pattern: str, *, level: str = "", at_least: int = 1, example: str = ""
) -> list[LogLine]:
    """The log lines in which a regular expression is found (capital letters don't count).

    level: DEBUG, INFO, WARN, ERROR or FATAL; "" for any. example: such a line, for who reads no patterns.
    Raises Missed when there are fewer than `at_least`.
    """
    example = example or pattern
    texts = [line for line in recording.logs if re.search(pattern, line.text, re.IGNORECASE)]
    found = [line for line in texts if level in ("", line.level)]
    if len(found) < at_least:
        many = "a log line" if at_least == 1 else f"{at_least} log lines"
        expected = f"{many}{f' at level {level}' if level else ''} like “{example}”"
        raise Missed(expected, *_nearest(recording, pattern, example, texts, found, level))
    return found


def _nearest(
    recording: Recording, pattern: str, example: str, texts: list[LogLine], found: list[LogLine], level: str
) -> tuple[str, str]:
    """What was seen instead, and a hint."""
    if found:
        return f"{len(found)}; the last at {found[-1].stamp:.3g} s", ""
    if texts:
        method = {"WARN": "warning"}.get(level, level.lower())
        return f"“{texts[0].text}” at level {texts[0].level}", f"Use self.get_logger().{method}(...)."
    printed = next((text for _, text in recording.prints if re.search(pattern, text, re.IGNORECASE)), "")
    if printed:
        return f"“{printed.strip()}”, printed", "Use self.get_logger().info(...) in place of print(...)."
    unfilled = next((line.text for line in recording.logs if re.search(r"\{\w[^}]*\}", line.text)), "")
    if unfilled:
        return f"“{unfilled}”", 'Put an f before the quotes: f"..." fills in what stands in braces.'
    similar = _most_similar(recording, example)
    if similar:
        return f"“{similar}”", "Compare the two texts letter by letter."
    if recording.logs:
        return f"no such line; the first line is “{recording.logs[0].text}”", ""
    return "no log line at all", ""


def _most_similar(recording: Recording, example: str) -> str:
    folded = {line.text.casefold(): line.text for line in reversed(recording.logs)}
    return next((folded[near] for near in difflib.get_close_matches(example.casefold(), folded, 1, 0.7)), "")


def answers(
    recording: Recording,
    topic: str,
    pattern: str | Callable[[Heard], str],
    *,
    level: str = "",
    within: Seconds = 0.5,
    where: Callable[[Heard], bool] = lambda heard: True,
) -> None:
    """Every message on a topic is answered by a log line soon after; partial credit for the part that is.

    pattern: regular expression, or a function that gives one for each message.
    where: picks the messages that want an answer.
    Raises Missed for the first message without an answer, ValueError when there are no messages to answer.
    """
    asked = [heard for heard in recording.messages(topic) if where(heard)]
    if not asked:
        raise ValueError(f"nothing was sent on {topic}, so there is nothing to answer")
    wanted = [pattern(heard) if callable(pattern) else pattern for heard in asked]
    open_ = [
        (heard, text)
        for heard, text in zip(asked, wanted, strict=True)
        if not _lines_after(recording, heard.stamp, within, text, level)
    ]
    if open_:
        heard, text = open_[0]
        expected = (
            f"a log line{f' at level {level}' if level else ''} like “{text}” after each message on {topic}"
        )
        raise Missed(expected, _instead(recording, heard, within), credit=1 - len(open_) / len(asked))


def _lines_after(recording: Recording, stamp: Seconds, within: Seconds, pattern: str, level: str) -> bool:
    return any(
        stamp <= line.stamp <= stamp + within
        and level in ("", line.level)
        and re.search(pattern, line.text, re.IGNORECASE)
        for line in recording.logs
    )


def _instead(recording: Recording, heard: Heard, within: Seconds) -> str:
    near = [line for line in recording.logs if heard.stamp <= line.stamp <= heard.stamp + within]
    said = f"“{near[0].text}” ({near[0].level})" if near else "no line"
    return f"{said} within {within:g} s of the message at {heard.stamp:.3g} s"
