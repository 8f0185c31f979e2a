"""Variants: every text follows, every model answer is full in its own variant, and a copied one isn't."""

import nbformat
import pytest

from grader.checks.check import Check
from grader.marking.judge.personal_release import personal_notebook
from grader.marking.submission.plain_cells import cell_of
from grader.marking.submission.sections import section_around
from grader.variants import with_phrases
from tests.exercises.assignment import is_slow
from tests.exercises.seeds import exercise_of
from tests.exercises.variants import (
    fallen_short,
    folders,
    judged,
    notebook_of,
    telling,
    topic_of,
    variants_of,
    varied,
)

FOLDERS = {  # and how many exercises with variants each has
    **{"01_nodes": 4, "02_topics": 3, "03_services": 3, "03b_settings": 3, "04_actions": 3},
    **{"05_sensing": 3, "05b_guarding": 2, "06_navigator": 1, "07_silence": 3, "08_joints": 3},
    **{"08b_drawing": 2, "09_frames": 3, "10_control": 3, "11_packages": 3, "11b_launching": 2},
    **{"12_safety": 2, "12b_lifecycle": 3, "13_warehouse": 2, "13b_delivery": 2, "14_bags": 2},
    **{"14b_covariance": 2, "14c_localization": 2},
}
SECRETS = 20  # `python -m tests.exercises.variants` tries 200
ROWS = [(folder, name) for folder in folders() for name in varied(folder)]
# Those whose answers are run: of what takes long only at night.
RUN = [
    pytest.param(*row, marks=[pytest.mark.soak] if is_slow(exercise_of(topic_of(row[0]), row[1])) else [])
    for row in ROWS
]


def texts_of(checks: list[Check]) -> list[str]:
    """All fixed sentences of some checks."""
    tables = [{item.guess: None} if isinstance(item.guess, str) else item.guess for item in checks]
    hints = [sentence for table in (*tables, *(item.hints for item in checks)) for sentence in table]
    return [*(item.sentence for item in checks), *hints]


def parts(folder: str, name: str, place: str) -> tuple[str, str]:
    """The text of an exercise's section and that of the rest, in an assignment's notebook."""
    cells = nbformat.read(notebook_of(folder, place), 4).cells
    line = f".{name}.grade("
    section = section_around(cells, next(at for at, cell in enumerate(cells) if line in cell.source))
    inside = "\n".join(cells[at].source for at in section)
    return inside, "\n".join(cell.source for at, cell in enumerate(cells) if at not in section)


def test_these_assignments_have_variants():
    assert {folder: len(varied(folder)) for folder in folders()} == FOLDERS


@pytest.mark.parametrize(("folder", "name"), ROWS)
def test_every_phrase_is_in_the_notebook(folder, name):
    exercise = exercise_of(topic_of(folder), name)
    inside, rest = parts(folder, name, "solutions")
    number = telling(variants_of(exercise))[1]
    changes = [(inside, variants_of(exercise).phrases(number))]
    changes += [(rest, variants_of(exercise).phrases_elsewhere(number))]
    unused = [old for text, phrases in changes for old, new in phrases.items()
              if with_phrases(text, {old: new}) == text and old != new]  # fmt: skip
    said = "\n".join(texts_of(exercise.checks))
    assert [old for old in unused if old not in said] == []


@pytest.mark.parametrize(("folder", "name"), ROWS)
def test_a_starter_in_another_variant_is_one_as_nbgrader_would_release_it(folder, name):
    exercise = exercise_of(topic_of(folder), name)
    number = variants_of(exercise).count - 1
    released = nbformat.read(notebook_of(folder, "exercises"), 4)
    own = personal_notebook(released, {exercise.name: number})
    assert [cell.id for cell in own.cells] == [cell.id for cell in released.cells]
    assert released == nbformat.read(notebook_of(folder, "exercises"), 4)
    for cell in map(cell_of, own.cells):
        assert cell.settings.get("checksum") in (None, cell.checksum)
    assert sum(f".variant({number}).grade(" in cell.source for cell in own.cells) == 1


@pytest.mark.parametrize(("folder", "name"), RUN)
def test_a_model_answer_is_full_in_its_own_variant(folder, name):
    for number in telling(variants_of(exercise_of(topic_of(folder), name))):
        check_answer(folder, name, number)


@pytest.mark.parametrize(("folder", "name"), RUN)
def test_an_answer_that_is_copied_from_another_variant_loses_points(folder, name):
    first, second, *_ = telling(variants_of(exercise_of(topic_of(folder), name)))
    check_copies(folder, name, first, [second])


@pytest.mark.soak
@pytest.mark.parametrize(("folder", "name"), ROWS)
def test_all_variants_have_their_own_answers(folder, name):
    count = variants_of(exercise_of(topic_of(folder), name)).count
    for number in range(count):
        check_answer(folder, name, number)
        check_copies(folder, name, number, [(number + 1) % count])


@pytest.mark.soak
@pytest.mark.parametrize(("folder", "name"), ROWS)
def test_model_answers_are_full_with_many_secrets(folder, name):
    assert list(fallen_short(folder, name, range(SECRETS))) == []


def check_answer(folder: str, name: str, number: int) -> None:
    score = judged(topic_of(folder), name, number)
    assert (number, float(score), score.broken) == (number, score.max, [])


def check_copies(folder: str, name: str, number: int, others: list[int]) -> None:
    scores = {other: judged(topic_of(folder), name, number, copied=other) for other in others}
    assert [other for other, score in scores.items() if score.broken or float(score) == score.max] == []
