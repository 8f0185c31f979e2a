"""Rebuilds the notebook that is run for a mark: the instructor's own, with a student's answers in it.

Taken from the submission are the text of the answers, released cells without points as the student changed
them, and the student's own cells, in their order. Everything else is the release's: no metadata, output, tag
or test of a submission changes what is run or what it is worth.
"""

import copy
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from nbformat import NotebookNode

from grader.course_files.notebook_format import cell_ids
from grader.marking.errors import Unusable
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.cell_matching import Match, match_cells
from grader.marking.submission.cell_order import CellPlace, order_cells
from grader.marking.submission.plain_cells import Cell, PlainNotebook, cell_of, is_answer
from grader.marking.submission.quoting import list_names
from grader.marking.submission.repair_notes import FLAGS, REPAIRS, Notes
from grader.marking.submission.submitted_files import SubmittedFiles
from grader.marking.submission.submitted_notebooks import read_notebooks

ANSWERED, UNTOUCHED, MISSING = "answered", "untouched", "missing"
VARIANT = re.compile(r"\.variant\(\d+\)")  # in the test cells of a student's own release
SETTINGS = ("points", "grade", "solution", "locked", "task")


@dataclass(frozen=True)
class RebuiltNotebook:
    """A notebook ready to run.

    answers: by grade_id, whether each was "answered", left "untouched" or is "missing". repairs: a sentence
    for student and instructor on each repair. flags: for the instructor alone, on each thing that honest work
    does not lead to.
    """

    notebook: NotebookNode
    answers: dict[str, str] = field(default_factory=dict)
    repairs: list[str] = field(default_factory=list)
    flags: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class RebuiltSubmission:
    """A submission ready to run: its notebooks by name.

    missing: why a notebook of the release cannot be marked, by its name. repairs, flags: of all notebooks, as
    in RebuiltNotebook.
    """

    notebooks: dict[str, RebuiltNotebook] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)
    repairs: list[str] = field(default_factory=list)
    flags: list[str] = field(default_factory=list)


def rebuild_submission(submitted: SubmittedFiles, release: Release) -> RebuiltSubmission:
    """Read a submission and rebuild all its notebooks. Raises Unusable if none can be marked."""
    read = read_notebooks(submitted, release)
    whole = RebuiltSubmission(missing=dict(read.missing), repairs=list(read.repairs))
    for name, notebook in read.notebooks.items():
        try:
            rebuilt = rebuild(release.notebooks[name], notebook)
        except Unusable as reason:
            whole.missing[name] = str(reason)
            continue
        whole.notebooks[name] = rebuilt
        whole.repairs.extend(rebuilt.repairs)
        whole.flags.extend(rebuilt.flags)
    if not whole.notebooks:
        raise Unusable(" ".join(whole.missing.values()))
    return whole


def rebuild(release: NotebookNode, submitted: PlainNotebook) -> RebuiltNotebook:
    """Return `release` with the answers and own cells of `submitted`; both stay as they are.

    Raises Unusable if those are not cells of this release.
    """
    released, submitted_cells = [cell_of(cell) for cell in release.cells], submitted.cells
    found = match_cells(released, submitted_cells)
    _refuse_other_assignment(released, submitted_cells, found)
    notes = Notes()
    _note_how_found(released, found, notes)
    nodes, answers, chosen = [], {}, {}
    own = set(range(len(submitted_cells))) - found.used()
    for r, (cell, node) in enumerate(zip(released, release.cells, strict=True)):
        copies = found.copies[r]
        if copies:
            chosen[r] = copies[-1]
        if is_answer(cell):
            real = [s for s in copies if not _untouched(submitted_cells[s], cell)]
            answers[cell.name] = ANSWERED if real else UNTOUCHED if copies else MISSING
            if real:
                chosen[r] = real[-1]
                own |= {s for s in real if submitted_cells[s].key != submitted_cells[real[-1]].key}
            _note_answer(cell, [submitted_cells[s] for s in copies], notes)
            nodes.append(_with_text(node, submitted_cells[chosen[r]].text if copies else "", cell.kind))
        elif cell.name:
            _note_fixed(cell, [submitted_cells[s] for s in copies], notes)
            nodes.append(_with_text(node, node.source, cell.kind))
        else:
            nodes.append(_plain(cell, node, [submitted_cells[s] for s in copies], notes))
    order, moved = order_cells(released, chosen, own)
    for r in moved:
        notes.add("moved", released[r].name or released[r].id)
    notebook = NotebookNode({**copy.deepcopy(release), "cells": _in_order(order, nodes, submitted_cells)})
    repairs = [*submitted.repairs, *notes.sentences(REPAIRS)]
    return RebuiltNotebook(notebook, answers, repairs, notes.sentences(FLAGS))


def _refuse_other_assignment(released: Sequence[Cell], submitted_cells: Sequence[Cell], found: Match) -> None:
    names = {cell.name for cell in released if cell.name}
    present = [cell.name for r, cell in enumerate(released) if cell.name and found.copies[r]]
    unknown = {cell.name: None for cell in submitted_cells if cell.name not in names and cell.name}
    if present and (len(present) >= len(unknown) or 2 * len(present) >= len(names)):
        return
    saw = f"those of another ({list_names(unknown)})" if unknown else "none of them"
    raise Unusable(
        f"Expected a notebook with this assignment's cells ({list_names(sorted(names))}), saw {saw}. "
        "Hand in the notebook of this assignment."
    )


def _note_how_found(released: Sequence[Cell], found: Match, notes: Notes) -> None:
    how = {"found by id": found.by_id, "found by text": found.by_text, "name of another": found.swapped}
    for about, cells in how.items():
        for r in sorted(cells):
            notes.add(about, released[r].name)


def _note_answer(cell: Cell, copies: Sequence[Cell], notes: Notes) -> None:
    if not copies:
        notes.add("answer missing", cell.name)
    if len(copies) > 1:
        notes.add("answer twice", cell.name)
    if any(copy.kind not in (cell.kind, "") for copy in copies):
        notes.add("answer of another type", cell.name)
    _note_settings(cell, copies, notes)


def _note_fixed(cell: Cell, copies: Sequence[Cell], notes: Notes) -> None:
    """Compare the copies of a cell that students must not change."""
    if not copies:
        notes.add("test missing", cell.name)
    if len(copies) > 1:
        notes.add("test twice", cell.name)
    for other in copies:
        if other.key != cell.key:
            older = "test of another variant" if _other_variant(other, cell) else "test older"
            notes.add(older if _as_released(other) else "test edited", cell.name)
        elif other.kind not in (cell.kind, ""):
            notes.add("test of another type", cell.name)
        if other.skipped:
            notes.add("test to be skipped", cell.name)
    _note_settings(cell, copies, notes)


def _note_settings(cell: Cell, copies: Iterable[Cell], notes: Notes) -> None:
    for other in copies:
        both = [key for key in SETTINGS if key in cell.settings and key in other.settings]
        if any(cell.settings[key] != other.settings[key] for key in both) and not _as_released(other):
            notes.add("settings changed", cell.name)


def _plain(cell: Cell, node: NotebookNode, copies: Sequence[Cell], notes: Notes) -> NotebookNode:
    if not copies and cell.kind == "code":
        notes.add("code missing", cell.id)
    text, kind = (copies[0].text, copies[0].kind) if copies else (node.source, "")
    return _with_text(node, text, kind or cell.kind)


def _with_text(node: NotebookNode, text: str, kind: str) -> NotebookNode:
    """The cell of the release with another text, without outputs."""
    if kind != node.cell_type:
        return _new(kind, text, node.id)
    node = copy.deepcopy(node)
    node.source = text
    if kind == "code":
        node.update(outputs=[], execution_count=None)
    return node


def _new(kind: str, text: str, cell_id: str) -> NotebookNode:
    ran: dict[str, Any] = {"outputs": [], "execution_count": None} if kind == "code" else {}
    return NotebookNode(id=cell_id, cell_type=kind, metadata=NotebookNode(), source=text, **ran)


def _in_order(
    order: Sequence[CellPlace], nodes: Sequence[NotebookNode], submitted_cells: Sequence[Cell]
) -> list[NotebookNode]:
    cells = []
    for place in order:
        own = None if place.released else submitted_cells[place.at]
        cells.append(_new(own.kind or "code", own.text, own.id) if own else nodes[place.at])
    reserved = {node.id for node in nodes}
    for place, cell in zip(order, cells, strict=True):
        if not place.released and cell.id in reserved:
            cell.id = ""
    for cell, cell_id in zip(cells, cell_ids(cells), strict=True):
        cell.id = cell_id
    return cells


def _untouched(cell: Cell, starter: Cell) -> bool:
    return cell.key == starter.key or _as_released(cell)


def _other_variant(cell: Cell, own: Cell) -> bool:
    """Return whether a test cell differs in its variant alone from the student's own."""
    return VARIANT.search(own.key) is not None and VARIANT.sub("", cell.key) == VARIANT.sub("", own.key)


def _as_released(cell: Cell) -> bool:
    """Return whether the cell is as in some version of the assignment, by nbgrader's checksum in it."""
    return bool(cell.settings.get("checksum") == cell.checksum)
