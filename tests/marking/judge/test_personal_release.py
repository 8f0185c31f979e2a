"""Each student's own release: what it has, and how answers to it and to others are marked."""

from dataclasses import replace

import nbformat
import pytest

from grader.exercises import topics
from grader.marking.errors import NoVariants
from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.judge.personal_release import (
    TAG,
    common_release,
    drawn_numbers,
    has_variants,
    personal_release,
    tag,
)
from grader.marking.result import Result
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.plain_cells import cell_of
from grader.seeds import revealed_seeds, secret_of_student
from grader.variants import with_phrases
from tests.marking.assignment import RIGHT, hand_in, release
from tests.marking.assignment import task as assigned

SECRET, STUDENT = "d1ce", "ann"
OWN = secret_of_student(SECRET, STUDENT)
EXERCISES = {"greeting": topics.greeting, "temperature": topics.temperature}


@pytest.fixture
def varied(tmp_path):
    """A released assignment with variants."""
    folder = release(tmp_path / "02_two")
    path = folder / "two.ipynb"
    notebook = nbformat.read(path, 4)
    tag(notebook, "02_two")
    for cell in notebook.cells:
        if "nbgrader" in cell.metadata:
            cell.metadata.nbgrader.checksum = cell_of(cell).checksum
    nbformat.write(notebook, path)
    return folder


@pytest.fixture
def marked(varied, tmp_path, start_student):
    """Marks ann's answers, each in the variant with the number after its name."""

    def do(secret: str = SECRET, **numbers: int) -> Result:
        answers = {
            name: with_phrases(RIGHT[name], EXERCISES[name].variants.phrases(number))
            for name, number in numbers.items()
        }
        task = hand_in(tmp_path / STUDENT, varied, answers)
        result = mark_submission(task, secret, lambda: start_student("none", begun=False).student)
        return Result.from_json(result_text(result))

    return do


def own_numbers(varied) -> dict[str, int]:
    return drawn_numbers(load_release(varied).notebooks.values(), OWN)


def points(result: Result) -> dict[str, float]:
    return {cell.exercise: cell.points for notebook in result.notebooks for cell in notebook.cells}


def test_a_release_without_variants_stays_as_it_is(tmp_path):
    common = load_release(release(tmp_path / "02_two"))
    assert personal_release(common, OWN) is common
    assert personal_release(common, "") is common
    assert drawn_numbers(common.notebooks.values(), OWN) == {}


def test_an_own_release_has_the_student_s_values_and_the_digest_of_the_common_one(varied):
    common = load_release(varied)
    own, numbers = personal_release(common, OWN), own_numbers(varied)
    texts = {cell.id: cell.source for cell in own.notebooks["two"].cells}
    assert numbers.keys() == {"greeting", "temperature"}
    assert texts["greeting-points"] == f"topics.greeting.variant({numbers['greeting']}).grade(Greeter)"
    assert (own.digest, has_variants(own.notebooks.values())) == (common.digest, False)
    assert TAG in common.notebooks["two"].cells[0].metadata["tags"]


def test_other_tags_stay(varied):
    common = load_release(varied)
    common.notebooks["two"].cells[0].metadata["tags"].insert(0, "mine")
    assert personal_release(common, OWN).notebooks["two"].cells[0].metadata["tags"] == ["mine"]


def test_nothing_is_drawn_without_a_secret(varied, marked):
    why = (
        "02_two has variants, which are drawn from the class's secret, and there is no secret: create it as "
        "grader/README.md says"
    )
    for ask in (lambda: personal_release(load_release(varied), ""), lambda: marked(secret="")):
        with pytest.raises(NoVariants) as refused:
            ask()
        assert str(refused.value) == why


def test_an_assignment_that_has_none_can_t_be_tagged():
    plain = nbformat.v4.new_notebook(cells=[nbformat.v4.new_markdown_cell("# Nothing")])
    with pytest.raises(NoVariants) as refused:
        tag(plain, "99_none")
    why = "99_none has no exercise with variants: leave out `variants = true` in class/course.toml"
    assert str(refused.value) == why


def test_answers_to_the_own_variants_earn_everything(varied, marked):
    result = marked(**own_numbers(varied))
    assert points(result) == {"greeting": 8.0, "temperature": 15.0}
    assert result.flags == []


def test_an_answer_to_another_variant_is_marked_against_the_own_one_and_flagged(varied, marked):
    numbers = own_numbers(varied)
    other = (numbers["greeting"] + 1) % topics.greeting.variants.count
    result = marked(**{**numbers, "greeting": other})
    assert points(result)["greeting"] < 8.0
    assert points(result)["temperature"] == 15.0
    there, here = (topics.greeting.variants.describe(number) for number in (other, numbers["greeting"]))
    assert result.flags == [
        "The test cell `greeting-points`: its nodes answer another variant of the task "
        f"({there}), as other students may have it, and would earn all points there; this student's own "
        f"({here}) counts."
    ]
    sentences = [v["sentence"] for note in result.notebooks for cell in note.cells for v in cell.verdicts]
    topic = topics.greeting.variants.values(numbers["greeting"])["topic"]
    assert sentences[0] == f"The node publishes String messages on {topic}."


def test_a_wrong_answer_to_the_own_variant_is_no_answer_to_another(varied, tmp_path, start_student):
    numbers = own_numbers(varied)
    phrases = {name: EXERCISES[name].variants.phrases(number) for name, number in numbers.items()}
    answers = {name: with_phrases(RIGHT[name], phrases[name]) for name in numbers}
    answers["greeting"] = answers["greeting"].replace("String(", "Float32(").replace('"Hello!"', "1.0")
    task = hand_in(tmp_path / STUDENT, varied, answers)
    result = mark_submission(task, SECRET, lambda: start_student("none", begun=False).student)
    assert points(result)["greeting"] < 8.0
    assert [flag for flag in result.flags if "another variant" in flag] == []


@pytest.mark.parametrize("common", [False, True])
def test_another_student_s_notebook_is_named_and_marked_against_the_own_variants(
    varied, tmp_path, start_student, common
):
    handed_out = load_release(varied)
    bobs = secret_of_student(SECRET, "bob")
    numbers = drawn_numbers(handed_out.notebooks.values(), bobs)
    notebook = (handed_out if common else personal_release(handed_out, bobs)).notebooks["two"]
    for cell in notebook.cells:
        if cell.id in RIGHT:
            number = 0 if common else numbers[cell.id]
            cell.source = with_phrases(RIGHT[cell.id], EXERCISES[cell.id].variants.phrases(number))
    (tmp_path / STUDENT).mkdir()
    nbformat.write(notebook, tmp_path / STUDENT / "two.ipynb")
    marked = mark_submission(
        assigned(tmp_path / STUDENT, varied), SECRET, lambda: start_student("none", begun=False).student
    )
    assert marked.repairs == [
        "The test cells `greeting-points` and `temperature-points` came from other variants of the tasks; "
        "those of the student's own were run."
    ]
    assert points(marked)["greeting"] < 8.0
    assert points(marked)["temperature"] < 15.0
    assert [flag.partition(" (")[0] for flag in marked.flags] == [
        f"The test cell `{name}-points`: its nodes answer another variant of the task" for name in RIGHT
    ]


def test_revealed_numbers_give_the_same_variants(varied):
    numbers = {"variant of greeting": [5], "variant of temperature": [3]}
    own = secret_of_student(revealed_seeds(numbers), STUDENT)
    assert drawn_numbers(load_release(varied).notebooks.values(), own) == {"greeting": 5, "temperature": 3}


def test_a_release_in_common_has_no_variants_that_could_be_drawn(varied, tmp_path, start_student):
    task = hand_in(tmp_path / STUDENT, varied)
    common = common_release(task.release)
    assert (has_variants(common.notebooks.values()), common.digest) == (False, task.release.digest)
    assert [cell.source for cell in common.notebooks["two"].cells] == [
        cell.source for cell in task.release.notebooks["two"].cells
    ]
    start = lambda: start_student("none", begun=False).student  # noqa: E731
    result = mark_submission(replace(task, release=common), "", start)
    assert points(result) == {"greeting": 8.0, "temperature": 15.0}


def test_a_procedure_has_the_common_release(varied, tmp_path, start_student):
    """As `likeness --runs` has it, which gives no points."""
    seen = []

    class Looks:
        def run(self, marking):
            seen.append(marking.task.release)

    task = replace(hand_in(tmp_path / STUDENT, varied), procedure=Looks())
    mark_submission(task, "", lambda: start_student("none", begun=False).student)
    assert seen == [task.release]
