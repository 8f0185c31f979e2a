"""Typos in a name, a number's type or a topic's type: the corrected program earns half of the points.

Names are those of topics, services, actions and parameters; in terminals, set-up lines count, too.
"""

from __future__ import annotations

import ctypes
import pkgutil
import re
import struct
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from grader.checks.typed import failed_lines
from grader.checks.verdicts import Verdict
from grader.diagnosis.names import misspelt
from grader.diagnosis.other_types import conflict
from grader.diagnosis.parameters import misspelt_parameter, whole_parameter
from sim import Process
from sim.evidence import CallbackError, Message, Recording

WORTH = 0.5  # of the points
MAX_CHAINED = 3  # each may hide the next: a name, a type, a number
OF_NUMBERS, OF_PARAMETERS, OF_LINES = "numbers", "parameters", "lines"
FORGIVEN = {OF_NUMBERS, OF_PARAMETERS, OF_LINES}
CORRECTED_HINT = "Graded as if the typo above were fixed, for half of the points."
# Of an action; rcl maps them one by one.
_PARTS = "send_goal", "cancel_goal", "get_result", "feedback", "status"
_PACKED = {"std_msgs/msg/Float32": ("<f", ctypes.c_float), "std_msgs/msg/Float64": ("<d", ctypes.c_double)}
_OF_A_VALUE = re.compile(r"to '([^']*)' of type '(INTEGER|STRING|DOUBLE)', expecting type '(INTEGER|DOUBLE)'")
_OF_A_NUMBER = re.compile(r"The '\w+' field must be of type '(float|int)'")


def typos_of(recording: Recording, verdicts: Sequence[Verdict]) -> list[str]:
    """Return the typos that a run and its verdicts show, in the form that `auto_correct` takes."""
    failed = any(verdict.status == "failed" for verdict in verdicts)
    pairs = [verdict.typo for verdict in verdicts if verdict.typo]
    pairs += misspelt(recording) if failed else []
    typos = [f"{wrong}:={right}" for wrong, right in pairs]
    if any(_is_of_numbers(error, recording) for error in recording.errors):
        typos.append(OF_NUMBERS)
    of_values = any(map(_is_of_a_value, recording.errors))
    if of_values or (failed and (misspelt_parameter(recording) or whole_parameter(recording))):
        typos.append(OF_PARAMETERS)
    if failed and failed_lines(recording):
        typos.append(OF_LINES)
    return list(dict.fromkeys(typos))


def _is_of_numbers(error: CallbackError, recording: Recording) -> bool:
    if error.type == "AssertionError":
        return _OF_A_NUMBER.search(error.text) is not None
    found = conflict(error, recording)
    return found is not None and {found.type, found.other.type} == set(_PACKED)


def _is_of_a_value(error: CallbackError) -> bool:
    """Return whether a parameter got 1 or "1.0" in place of 1.0, or has a default of 1 and got 0.5."""
    found = _OF_A_VALUE.search(error.text) if error.type == "InvalidParameterTypeException" else None
    return found is not None and re.fullmatch(r"\s*[+-]?\d+\.?\d*\s*", found[1]) is not None


def auto_correct(program: Any, preparation: Sequence[Any], *typos: str) -> Any:
    """Return a student's program as a scenario prepares it, with these typos corrected.

    Of a launch file only the numbers that it gives to parameters are corrected.

    preparation: the scenario's own, serialized: the name of a function and its arguments; [] for none.
    """
    for name in preparation[:1]:
        program = pkgutil.resolve_name(name)(program, *preparation[1:])
    if isinstance(program, list):  # several programs were made of it
        return [auto_correct(one, [], *typos) for one in program]
    if isinstance(program, str):
        return program if FORGIVEN.isdisjoint(typos) else Process(program, lenient=True)
    process = program if isinstance(program, Process) else Process(program)
    names = [typo.split(":=") for typo in typos if not _of_a_type(typo) and typo not in FORGIVEN]
    rules = [(wrong, right) for wrong, right in names]
    rules += [
        (f"{wrong}/_action/{part}", f"{right}/_action/{part}")
        for wrong, right in names
        if wrong.startswith("/")
        for part in _PARTS
    ]
    remappings = [*process.remappings, *rules]
    return replace(process, remappings=remappings, lenient=not FORGIVEN.isdisjoint(typos))


def only_wrong_types(typos: Sequence[str]) -> bool:
    """Return whether `with_right_types` corrects all of these typos, so that no further run is needed."""
    return all(map(_of_a_type, typos))


def with_right_types(recording: Recording, typos: Sequence[str]) -> Recording:
    """Return the recording with the student's messages and endpoints in the type that the exercise wants."""
    kinds = dict(typo.split(":=") for typo in typos if _of_a_type(typo))

    def right(row: Any) -> Any:
        if row.from_course or row.type not in kinds:
            return row
        return row._replace(type=kinds[row.type], **_repacked(row, kinds[row.type]))

    graph = replace(recording.graph, endpoints=[right(end) for end in recording.graph.endpoints])
    return replace(recording, published=[right(message) for message in recording.published], graph=graph)


def _repacked(row: Any, kind: str) -> dict[str, bytes]:
    if not isinstance(row, Message):
        return {}
    code, number = _PACKED[kind]
    return {"raw": row.raw[:4] + struct.pack(code, number(row.message.data).value)}


def _of_a_type(typo: str) -> bool:
    return typo.partition(":=")[0] in _PACKED


def partial_credit(given: Sequence[Verdict], without: Sequence[Verdict]) -> list[Verdict]:
    """Return the verdicts, each with half of what the corrected program earns where that is more."""
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
    return replace(given, status="skipped", credit=credit, hint=CORRECTED_HINT)
