"""An autograder that can't know a student's variants isn't written."""

import nbformat
import pytest

from grader.__main__ import main
from grader.marking.errors import NoVariants
from grader.marking.extras.platforms.common_tests import require_known_variants
from grader.marking.judge.personal_release import TAG

NAME = "01_varied"
WHY = (
    "01_varied has variants, which follow from the class's secret and the student's name: of the platforms "
    "only gradescope has both, without --public-worlds"
)


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course whose assignments have the tag of one with variants, and none."""
    for name, tags in ((NAME, [TAG]), ("02_same", [])):
        first = nbformat.v4.new_markdown_cell("# Title", metadata={"tags": tags})
        (tmp_path / "exercises" / name).mkdir(parents=True)
        nbformat.write(
            nbformat.v4.new_notebook(cells=[first]), tmp_path / "exercises" / name / "notebook.ipynb"
        )
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("platform", "secret"), [
    ("gradescope", False), ("classroom50", False), ("prairielearn", True), ("prairielearn", False),
])  # fmt: skip
def test_where_variants_can_t_be_drawn_it_is_refused(course, platform, secret):
    with pytest.raises(NoVariants) as refused:
        require_known_variants(course, NAME, platform, secret)
    assert str(refused.value) == WHY
    require_known_variants(course, "02_same", platform, secret)


def test_gradescope_with_the_secret_can_draw_them(course):
    require_known_variants(course, NAME, "gradescope", True)


def test_the_command_says_so(course, capsys):
    assert main(["platform", "prairielearn", NAME]) == 1
    assert capsys.readouterr().err == f"No autograder: {WHY}.\n"
