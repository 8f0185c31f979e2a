"""Slips of a name, of a number's type and of a topic's: what the program would have done is worth half.

Names are those of topics, services and actions, and of parameters.
"""

from __future__ import annotations

import ctypes
import pkgutil
import re
import struct
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from grader.checks.judge import Verdict
from grader.diagnosis.names import misspelt
from grader.diagnosis.other_types import conflict
from grader.diagnosis.parameters import misspelt_parameter, whole_parameter
from sim import Process
from sim.evidence import CallbackError, Message, Recording

WORTH = 0.5  # of the points
MOST_AFTER_ANOTHER = 3  # each may hide the next: a name, a type, a number
OF_NUMBERS, OF_PARAMETERS = "numbers", "parameters"
FORGIVEN = {OF_NUMBERS, OF_PARAMETERS}
MENDED = "Judged as if the slip above were mended, for half of the points."
# Of an action; rcl maps them one by one.
_PARTS = "send_goal", "cancel_goal", "get_result", "feedback", "status"
_PACKED = {"std_msgs/msg/Float32": ("<f", ctypes.c_float), "std_msgs/msg/Float64": ("<d", ctypes.c_double)}
_OF_A_NUMBER = re.compile(r"The '\w+' field must be of type '(float|int)'")


def slips_of(recording: Recording, verdicts: Sequence[Verdict]) -> list[str]:
    """What `mended` has to mend, for the slips that a run and its verdicts show."""
    failed = any(verdict.status == "failed" for verdict in verdicts)
    pairs = [verdict.slip for verdict in verdicts if verdict.slip]
    pairs += misspelt(recording) if failed else []
    slips = [f"{wrong}:={right}" for wrong, right in pairs]
    if any(_is_of_numbers(error, recording) for error in recording.errors):
        slips.append(OF_NUMBERS)
    if failed and (misspelt_parameter(recording) or whole_parameter(recording)):
        slips.append(OF_PARAMETERS)
    return list(dict.fromkeys(slips))


def _is_of_numbers(error: CallbackError, recording: Recording) -> bool:
    if error.type == "AssertionError":
        return _OF_A_NUMBER.search(error.text) is not None
    found = conflict(error, recording)
    return found is not None and {found.type, found.other.type} == set(_PACKED)


def mended(program: Any, preparation: Sequence[Any], *slips: str) -> Any:
    """What a scenario makes of a student's program, without these slips; a launch file stays as it is.

    preparation: the scenario's own: the name of a function, and further words for it; [] for none.
    """
    for name in preparation[:1]:
        program = pkgutil.resolve_name(name)(program, *preparation[1:])
    if isinstance(program, list):  # several programs were made of it
        return [mended(one, [], *slips) for one in program]
    if isinstance(program, str):
        return program
    process = program if isinstance(program, Process) else Process(program)
    names = [slip.split(":=") for slip in slips if not _of_a_type(slip) and slip not in FORGIVEN]
    rules = [(wrong, right) for wrong, right in names]
    rules += [
        (f"{wrong}/_action/{part}", f"{right}/_action/{part}")
        for wrong, right in names
        if wrong.startswith("/")
        for part in _PARTS
    ]
    remappings = [*process.remappings, *rules]
    return replace(process, remappings=remappings, forgiving=not FORGIVEN.isdisjoint(slips))


def in_what_was_sent(slips: Sequence[str]) -> bool:
    """Whether `retyped` mends all of these slips, and no run without them is needed."""
    return all(map(_of_a_type, slips))


def retyped(recording: Recording, slips: Sequence[str]) -> Recording:
    """What was recorded, with what a student's program sent and declared in the type that was asked for."""
    kinds = dict(slip.split(":=") for slip in slips if _of_a_type(slip))

    def right(row: Any) -> Any:
        if row.from_course or row.type not in kinds:
            return row
        return row._replace(type=kinds[row.type], **_repacked(row, kinds[row.type]))

    graph = replace(recording.graph, endpoints=[right(end) for end in recording.graph.endpoints])
    return replace(recording, published=[right(heard) for heard in recording.published], graph=graph)


def _repacked(row: Any, kind: str) -> dict[str, bytes]:
    if not isinstance(row, Message):
        return {}
    code, number = _PACKED[kind]
    return {"raw": row.raw[:4] + struct.pack(code, number(row.message.data).value)}


def _of_a_type(slip: str) -> bool:
    return slip.partition(":=")[0] in _PACKED


def with_half(given: Sequence[Verdict], without: Sequence[Verdict]) -> list[Verdict]:
    """The verdicts on a program, with half of what it earns without its slips where that is more."""
    again = {verdict.name: verdict for verdict in without}
    return [_better(verdict, again.get(verdict.name)) for verdict in given]


def _better(given: Verdict, without: Verdict | None) -> Verdict:
    if without is None or not given.points:
        return given
    credit = WORTH * without.credit
    if credit <= given.credit and not without.unsafe:
        return given
    if given.status == "failed":
        return replace(given, credit=max(credit, given.credit), unsafe=given.unsafe or without.unsafe)
    if without.status == "failed":
        return replace(without, credit=max(credit, given.credit), picture="")
    return replace(given, status="skipped", credit=credit, hint=MENDED)
