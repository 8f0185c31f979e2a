"""A student's own release, where numbers and names are drawn for each student; see `grader/variants.py`.

The release of an assignment with variants has a tag in each notebook. From it, the secret and the student's
name follow the student's notebooks: what the instructor hands out, and what the judge rebuilds and runs.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from nbformat import NotebookNode

from grader.exercise import Exercise
from grader.marking.errors import NoVariants
from grader.marking.judge.testcells import exercise_names, find_exercise, is_test
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.plain_cells import cell_of
from grader.marking.submission.sections import section_around
from grader.variants import Variants, drawn_number, with_phrases

TAG = "variants"  # of a notebook's first cell
GRADES = re.compile(r"\.grade\(")
NO_SECRET = (
    "{} has variants, which are drawn from the class's secret, and there is no secret: create it as "
    "grader/README.md says"
)
NO_EXERCISE = "{} has no exercise with variants: leave out `variants = true` in class/course.toml"


def has_variants(notebooks: Iterable[NotebookNode]) -> bool:
    """Return whether one of these released notebooks is different for each student."""
    return any(TAG in _tags(notebook) for notebook in notebooks)


def tag(notebook: NotebookNode, assignment: str) -> None:
    """Tag a notebook as one with variants. Raises NoVariants if none of its exercises has any."""
    if not varied_exercises(notebook):
        raise NoVariants(NO_EXERCISE.format(assignment))
    notebook.cells[0].metadata["tags"] = [*_tags(notebook), TAG]


def drawn_numbers(notebooks: Iterable[NotebookNode], secret: str) -> dict[str, int]:
    """The numbers of a student's variants, by the exercise's name; {} for a release without variants.

    secret: the student's, as `secret_of_student` derives it.
    """
    tagged = (notebook for notebook in notebooks if has_variants([notebook]))
    varied = [each for notebook in tagged for each in varied_exercises(notebook)]
    return {each.name: drawn_number(secret, each.name, _variants(each).count) for each in varied}


def personal_release(release: Release, secret: str) -> Release:
    """A student's own release; its digest stays that of the common one. Raises NoVariants without a secret.

    secret: the student's, as `secret_of_student` derives it.
    """
    if not has_variants(release.notebooks.values()):
        return release
    if not secret:
        raise NoVariants(NO_SECRET.format(release.assignment))
    numbers = drawn_numbers(release.notebooks.values(), secret)
    own = {name: personal_notebook(notebook, numbers) for name, notebook in release.notebooks.items()}
    return replace(release, notebooks=own)


def common_release(release: Release) -> Release:
    """A release for which no variants are drawn, whether or not it has some."""
    return replace(release, notebooks={name: _untagged(it) for name, it in release.notebooks.items()})


def personal_notebook(notebook: NotebookNode, numbers: Mapping[str, int]) -> NotebookNode:
    """A notebook, with or without answers, in the variants with these numbers, by the exercise's name."""
    notebook = _untagged(notebook)
    for cell, phrases in zip(notebook.cells, _phrases(notebook, numbers), strict=True):
        _set_text(cell, with_phrases(cell.source, phrases))
    tests = {cell.metadata.nbgrader.grade_id: cell for cell in notebook.cells if is_test(cell)}
    for name, exercise in _exercises(notebook).items():
        if exercise.name in numbers:
            chosen = f".variant({numbers[exercise.name]}).grade("
            _set_text(tests[name], GRADES.sub(chosen, tests[name].source, count=1))
    return notebook


def varied_exercises(notebook: NotebookNode) -> list[Exercise]:
    """The exercises of a notebook that have variants."""
    return [each for each in _exercises(notebook).values() if each.variants]


def _phrases(notebook: NotebookNode, numbers: Mapping[str, int]) -> Sequence[dict[str, str]]:
    """What is replaced in each cell."""
    found: list[dict[str, str]] = [{} for _ in notebook.cells]
    tests = {cell.metadata.nbgrader.grade_id: at for at, cell in enumerate(notebook.cells) if is_test(cell)}
    for name, exercise in _exercises(notebook).items():
        if exercise.name in numbers:
            variants, number = _variants(exercise), numbers[exercise.name]
            section = section_around(notebook.cells, tests[name])
            for at, phrases in enumerate(found):
                phrases |= variants.phrases(number) if at in section else variants.phrases_elsewhere(number)
    return found


def _exercises(notebook: NotebookNode) -> dict[str, Exercise]:
    """The exercises of a notebook by the grade_id of the test cell."""
    return {cell: find_exercise(full) for cell, full in exercise_names(notebook).items() if full}


def _set_text(cell: NotebookNode, text: str) -> None:
    """Change a cell's text, and nbgrader's checksum, by which an unchanged starter is recognized."""
    if text == cell.source:
        return
    cell.source = text
    settings = cell.metadata.get("nbgrader", {})
    if "checksum" in settings:
        settings["checksum"] = cell_of(cell).checksum


def _untagged(notebook: NotebookNode) -> NotebookNode:
    """A copy without the tag."""
    notebook = copy.deepcopy(notebook)
    if tags := [each for each in _tags(notebook) if each != TAG]:
        notebook.cells[0].metadata["tags"] = tags
    elif notebook.cells:
        notebook.cells[0].metadata.pop("tags", None)
    return notebook


def _tags(notebook: NotebookNode) -> list[Any]:
    return list(notebook.cells[0].metadata.get("tags", [])) if notebook.cells else []


def _variants(exercise: Exercise) -> Variants:
    assert exercise.variants is not None
    return exercise.variants
