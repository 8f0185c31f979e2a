import subprocess
import sys

import pytest

from tests.marking.hostile.corpus import DAMAGES, HONEST, ROOT, SECRET, block, course, mark, page, submit

FILES = sorted(file.stem for file in (ROOT / "tests" / "students" / "hostile").glob("*.py"))
EVERYBODY = [*HONEST, *FILES, *(trick.__name__ for trick in DAMAGES)]
BURNERS = 3


@pytest.fixture(scope="module")
def everybody(tmp_path_factory):
    folder = course(tmp_path_factory.mktemp("everybody"))
    return mark(folder, submit(folder))


@pytest.fixture(scope="module")
def honest(tmp_path_factory):
    """The honest alone, one after the other."""
    folder = course(tmp_path_factory.mktemp("honest"))
    return mark(folder, submit(folder, [*HONEST]), jobs=1)


@pytest.mark.parametrize("name", EVERYBODY)
def test_a_submission_gets_its_points_and_words(everybody, name):
    assert block(everybody[name]) == page().get(name)


def test_the_page_speaks_of_everybody():
    assert list(page()) == EVERYBODY


@pytest.mark.soak
@pytest.mark.parametrize("name", HONEST)
def test_the_honest_get_byte_for_byte_what_they_get_alone(everybody, honest, name):
    assert everybody[name].grade_json() == honest[name].grade_json()


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


def test_nothing_that_comes_back_tells_the_secret(everybody):
    assert [name for name, result in everybody.items() if SECRET in result.to_json()] == []


def test_nobody_earns_by_a_trick_what_an_honest_half_does_not(everybody):
    # teleported_robot sends commands, as two of the points of `square` ask
    allowed = {name: 15.0 for name in EVERYBODY} | {"honest_right": 33.0, "teleported_robot": 17.0}
    assert {name: r.points for name, r in everybody.items() if r.points > allowed[name]} == {}
