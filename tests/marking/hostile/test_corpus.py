import subprocess
import sys

import pytest

from tests.marking.hostile.corpus import DAMAGES, HONEST, ROOT, SECRET, block, course, mark, page, submit

FILES = sorted(file.stem for file in (ROOT / "tests" / "students" / "hostile").glob("*.py"))
EVERYBODY = [*HONEST, *FILES, *(trick.__name__ for trick in DAMAGES)]
# One for each place where a trick takes hold; their siblings are for the night. Each flag, each repair and
# each way to be stopped has a cheaper test of its own, in submission/, judge/, sandbox/ and student_process/.
EVERY_DAY = [
    *HONEST,
    *("forged_recording", "fake_messages", "teleported_robot", "speaks_as_the_robot"),  # evidence
    *("patched_exercise", "graded_by_proxy", "replaced_run_cell"),  # who judges
    *("wire_forger", "takes_over_the_wire"),  # what goes to the judge
    *("secret_reader", "fork_bomb"),  # the sandbox
    *("ends_the_process", "segmentation_fault"),  # the end
    *("edited_test_cell", "duplicated_test_cell", "broken_json", "missing_notebook", "linked_secret"),
]
AT_NIGHT = [name for name in EVERYBODY if name not in EVERY_DAY]
BURNERS = 3


SORTS = [
    pytest.param(EVERY_DAY, id="every day"),
    pytest.param(AT_NIGHT, id="at night", marks=pytest.mark.soak),
]


@pytest.fixture(scope="module", params=SORTS)
def marked(request, tmp_path_factory):
    """Some of them, marked as a class."""
    folder = course(tmp_path_factory.mktemp("class"))
    return mark(folder, submit(folder, request.param))


@pytest.fixture(scope="module")
def honest(tmp_path_factory):
    """The honest alone, one after the other."""
    folder = course(tmp_path_factory.mktemp("honest"))
    return mark(folder, submit(folder, [*HONEST]), jobs=1)


def test_a_submission_gets_its_points_and_words(marked):
    assert {name: block(result) for name, result in marked.items()} == {name: page()[name] for name in marked}


def test_the_page_speaks_of_everybody():
    assert list(page()) == EVERYBODY


@pytest.mark.soak
@pytest.mark.parametrize("marked", [EVERY_DAY], indirect=True, ids=["every day"])
def test_the_honest_get_byte_for_byte_what_they_get_alone(marked, honest):
    assert {name: marked[name].grade_json() for name in HONEST} == {
        name: result.grade_json() for name, result in honest.items()
    }


@pytest.mark.soak
def test_on_a_busy_machine_marks_and_digests_are_the_same(tmp_path, honest):
    folder = course(tmp_path)
    names = submit(folder, [*HONEST])
    burners = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(BURNERS)]
    try:
        busy = mark(folder, names)
    finally:
        for burner in burners:
            burner.kill()
            burner.wait()
    assert [result.grade_json() for result in busy.values()] == [
        result.grade_json() for result in honest.values()
    ]
    assert all(cell.digests for result in busy.values() for cell in result.notebooks[0].cells)


def test_nothing_that_comes_back_contains_the_secret(marked):
    assert [name for name, result in marked.items() if SECRET in result.to_json()] == []


def test_no_one_earns_by_a_trick_what_an_honest_half_does_not(marked):
    # teleported_robot sends commands, as two of the points of `square` ask
    allowed = {name: 15.0 for name in EVERYBODY} | {"honest_right": 33.0, "teleported_robot": 17.0}
    assert {name: r.points for name, r in marked.items() if r.points > allowed[name]} == {}
