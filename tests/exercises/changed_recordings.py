"""Recordings of right nodes in which one thing that the student sent is changed: each field of each message.

python -m tests.exercises.changed_recordings [EXERCISE ...] prints what a field earns that is NaN or infinite,
beside what it earns with a wrong number.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any
from unittest import mock

from grader import Exercise, Score
from grader.checks.verdicts import judge, worst
from sim.evidence import INFRASTRUCTURE_TOPICS, Call, Goal, Message, Recording, is_node_service
from sim.ros.messages.codec import encode, message_class
from sim.ros.messages.decoder import decode

NO_NUMBERS = math.nan, math.inf, -math.inf
WRONG_NUMBERS = 1e6, -1e6
FLOATS = "float", "double"
TEXTS = "", "nan", "-1e999", "9" * 5000, "ä\n" * 500
OTHER_VALUES = {"string": TEXTS, "boolean": (False, True), "octet": (b"\x00", b"\xff")}
WHOLE = 0, 120  # they fit into each type of whole numbers
MOST_DEPTH = 6
TYPE = re.compile(r"(?:sequence<)?([\w/]+)(?:<\d+>)?(?:, \d+)?>?(?:\[\d+\])?")


@dataclass(frozen=True, order=True)
class Field:
    """A field of what the student sent; a list counts as a whole, and so do the values of a list.

    kind: topic, request, response, goal, feedback or result. name: the topic's, service's or action's.
    path: such as poses[].position.x. type: of the value; "list" for a list as a whole.
    """

    kind: str
    name: str
    path: str
    type: str

    def __str__(self) -> str:
        return f"{self.kind} {self.name} {self.path}"


def fields_of(recording: Recording) -> list[Field]:
    """Every field of each type of message that the student's programs sent."""
    found: set[Field] = set()
    for row in recording.published:
        if not row.from_course and row.topic not in INFRASTRUCTURE_TOPICS:
            found |= {Field("topic", row.topic, *leaf) for leaf in leaves(row.type)}
    for call in recording.calls:
        if not is_node_service(call.service):
            for kind, type_, own in _parts_of_call(call):
                found |= {Field(kind, call.service, *leaf) for leaf in leaves(type_) if own}
    for goal in recording.goals:
        for kind, type_, own in _parts_of_goal(goal):
            found |= {Field(kind, goal.action, *leaf) for leaf in leaves(type_) if own}
    return sorted(found)


def _parts_of_call(call: Call) -> Iterator[tuple[str, str, bool]]:
    yield "request", f"{call.type}_Request", not call.requested_by_course
    yield "response", f"{call.type}_Response", call.raw_response is not None and not call.served_by_course


def _parts_of_goal(goal: Goal) -> Iterator[tuple[str, str, bool]]:
    yield "goal", f"{goal.type}_Goal", not goal.requested_by_course
    yield "result", f"{goal.type}_Result", goal.raw_result is not None and not goal.served_by_course
    yield "feedback", f"{goal.type}_Feedback", bool(goal.feedback) and not goal.served_by_course


def leaves(type_: str, depth: int = 0) -> Iterator[tuple[str, str]]:
    """The path and the type of each value in a message of this type."""
    for name, declared in message_class(type_).get_fields_and_field_types().items():
        is_list = declared.startswith("sequence<")
        label = name + "[]" * (is_list or declared.endswith("]"))
        if is_list:
            yield name, "list"
        base = TYPE.fullmatch(declared)[1]
        if "/" not in base:
            yield label, base
        elif depth < MOST_DEPTH:
            inner = leaves(base.replace("/", "/msg/"), depth + 1)
            yield from ((f"{label}.{path}", kind) for path, kind in inner)


def changes(
    recording: Recording, field: Field, values: Iterable[Any], begin: float = 0.0
) -> Iterator[Recording]:
    """The recording with each of these values in a field of all that the student sent from a stamp on.

    Of a list as a whole a value is how many of its items are left.
    """
    # A message is decoded once for all values, if they take each other's place.
    message_of = decode if field.type == "list" else cache(decode)
    for value in values:
        yield _changed(recording, field, value, begin, message_of)


def _changed(
    recording: Recording, field: Field, value: Any, begin: float, message_of: Callable[[str, bytes], Any]
) -> Recording:
    def raw(message: Any) -> bytes:
        put(message, field.path, value, whole=field.type == "list")
        return encode(message)

    def with_value(row: Message) -> Message:
        return row._replace(raw=raw(message_of(row.type, row.raw)))

    if field.kind == "topic":
        return _with_messages(recording, field.name, begin, with_value)
    if field.kind in ("request", "response"):
        calls = [_changed_call(call, field, raw) for call in recording.calls]
        return replace(recording, calls=calls)
    return replace(recording, goals=[_changed_goal(goal, field, raw) for goal in recording.goals])


def _with_messages(
    recording: Recording, topic: str, begin: float, change: Callable[[Message], Message]
) -> Recording:
    published = [
        change(row) if row.topic == topic and not row.from_course and row.stamp >= begin else row
        for row in recording.published
    ]
    return replace(recording, published=published)


def _changed_call(call: Call, field: Field, raw: Callable[[Any], bytes]) -> Call:
    own = {kind for kind, _, is_own in _parts_of_call(call) if is_own}
    if call.service != field.name or field.kind not in own:
        return call
    return replace(call, **{f"raw_{field.kind}": raw(getattr(call, field.kind))})


def _changed_goal(goal: Goal, field: Field, raw: Callable[[Any], bytes]) -> Goal:
    own = {kind for kind, _, is_own in _parts_of_goal(goal) if is_own}
    if goal.action != field.name or field.kind not in own:
        return goal
    if field.kind == "feedback":
        return replace(goal, feedback=[row._replace(raw=raw(row.message)) for row in goal.feedback])
    part = {"goal": "request", "result": "result"}[field.kind]
    return replace(goal, **{f"raw_{part}": raw(getattr(goal, part))})


def put(message: Any, path: str, value: Any, *, whole: bool = False) -> None:
    """Set a field of a message, in each item of the lists on its path.

    whole: the field is a list, and the value is how many of its items are left.
    """
    head, _, rest = path.partition(".")
    name = head.removesuffix("[]")
    found = getattr(message, name)
    if rest:
        for item in found if head.endswith("[]") else [found]:
            put(item, rest, value, whole=whole)
    elif whole:
        setattr(message, name, found[:value])
    else:
        setattr(message, name, [value] * len(found) if head.endswith("[]") else value)


def other_values(field: Field) -> tuple[Any, ...]:
    """Values that a student's program may send in this field; for a list, how many items are left of it."""
    if field.type in FLOATS:
        return (*NO_NUMBERS, *WRONG_NUMBERS)
    return (0, 1, -1) if field.type == "list" else OTHER_VALUES.get(field.type, WHOLE)


def other_recordings(recording: Recording) -> Iterator[tuple[str, Recording]]:
    """The recording with one field changed, less of what was sent, or other log lines; and what that is.

    Fields of decimal numbers are left to `strange_numbers`.
    """
    for field in fields_of(recording):
        values = () if field.type in FLOATS else other_values(field)
        for value, other in zip(values, changes(recording, field, values), strict=True):
            yield f"{field}: {value!r:.20}", other
    for topic in {field.name for field in fields_of(recording) if field.kind == "topic"}:
        own = [row for row in recording.messages(topic) if not row.from_course]
        for what, left in (("no", []), ("the first", own[:1]), ("the last", own[-1:])):
            others = [row for row in recording.published if row.topic != topic or row.from_course]
            rows = sorted([*others, *left], key=lambda row: row.stamp)
            yield f"{what} message on {topic}", replace(recording, published=rows)
    for text in TEXTS:
        lines = [line if line.from_course else line._replace(text=text) for line in recording.logs]
        prints = [(stamp, text) for stamp, _ in recording.prints]
        yield f"lines and prints {text!r:.20}", replace(recording, logs=lines, prints=prints)
    for digits in (400, 5000):
        numbers = [line if line.from_course else line._replace(text=re.sub(r"\d+", "9" * digits, line.text))
                   for line in recording.logs]  # fmt: skip
        yield f"numbers of {digits} digits in all lines", replace(recording, logs=numbers)
    no_answers = [replace(call, answered=None, raw_response=None) for call in recording.calls]
    yield "no responses", replace(recording, calls=no_answers)
    no_results = [replace(goal, events=goal.events[:1], raw_result=None) for goal in recording.goals]
    yield "no results", replace(recording, goals=no_results)


@lru_cache(20_000)
def _decoded(name: str, raw: bytes) -> Any:
    return decode(name, raw)


def score_of(exercise: Exercise, recordings: list[Recording]) -> Score:
    """What recordings of all runs of an exercise earn.

    Most of their messages are in the last recordings, too: here checks share what is decoded, and alter none.
    """
    runs = zip(exercise.runs(), recordings, strict=True)
    with mock.patch("sim.ros.messages.decoder.decode", _decoded):
        judged = [judge(exercise.checks, run, it.name, may_end=exercise.may_end) for (it, _), run in runs]
    return Score(exercise.name, worst(exercise.checks, judged), recordings)


def strange_numbers(exercise: Exercise, recordings: list[Recording]) -> Iterator[tuple[str, list[Score]]]:
    """What a field earns with each of NO_NUMBERS and WRONG_NUMBERS, in all of a run and in half."""
    for field in sorted({field for run in recordings for field in fields_of(run) if field.type in FLOATS}):
        for part, when in (("", 0.0), (" from the middle on", 0.5)):
            runs = [changes(run, field, other_values(field), when * run.stamp) for run in recordings]
            yield f"{field}{part}", [score_of(exercise, [*each]) for each in zip(*runs, strict=True)]


def main(words: list[str]) -> None:
    """Print the table."""
    from tests.exercises.assignment import first_run
    from tests.exercises.builds import kept_builds
    from tests.exercises.chance import card_of, named_exercises

    numbers = [f"{value:g}" for value in (*NO_NUMBERS, *WRONG_NUMBERS)]
    print(f"{'':60}", *(f"{number:>8}" for number in numbers))
    with kept_builds():
        for topic, name, exercise in named_exercises(words):
            for field, scores in strange_numbers(first_run(exercise), card_of(topic, name).runs):
                print(f"{name + ' ' + field:60}", *(f"{float(score):8g}" for score in scores), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
