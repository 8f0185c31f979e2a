"""Hostile packages, marked as a class: what each gets, and that nothing is left of them."""

from pathlib import Path

import pytest

from tests.marking.hostile.corpus import SECRET
from tests.marking.hostile.packages import TRICKS, mark, page, reported

# One for each place where a trick takes hold; their siblings are for the night.
EVERY_DAY = [
    *("honest", "setup_prints_a_score", "entry_point_elsewhere", "linked_secret", "thousands_of_files"),
    *("cell_answers_for_the_workspace", "cmake_runs_programs"),
]
AT_NIGHT = [name for name in TRICKS if name not in EVERY_DAY]
SORTS = [
    pytest.param(EVERY_DAY, id="every day"),
    pytest.param(AT_NIGHT, id="at night", marks=pytest.mark.soak),
]
BUILT, READ = 16.0, 18.0


@pytest.fixture(scope="module", params=SORTS)
def marked(request, tmp_path_factory):
    return mark(tmp_path_factory.mktemp("class"), request.param)


def test_a_package_gets_its_points_and_words(marked):
    expected = {name: page()[name] for name in marked}
    assert {name: reported(result) for name, result in marked.items()} == expected


def test_the_page_speaks_of_everybody():
    assert list(page()) == list(TRICKS)


def test_nothing_that_comes_back_contains_the_secret(marked):
    assert [name for name, result in marked.items() if SECRET in result.to_json()] == []


def test_nothing_is_left_on_this_machine(marked):
    places = "/tmp/ran", "/tmp/left_by_setup", "/left_by_setup", "/etc/setup.py", "~/left_by_setup"
    assert [place for place in places if Path(place).expanduser().exists()] == []
