import pytest

pytestmark = pytest.mark.browser


def test_lab_starts_in_the_first_lesson(lab):
    lab.open()
    assert lab.page.locator(".lm-TabBar-tabLabel", has_text="lesson.ipynb").is_visible()
    lab.screenshot("first_lesson")


def test_the_instructors_panels_are_hidden(lab):
    lab.open("tiny/wrong.ipynb")
    assert lab.page.locator(".validate-button").is_visible()
    panels = ("formgrader", "formgrader-local", "create-assignment", "assignment-list", "course-list")
    assert [name for name in panels if lab.has_command(f"nbgrader:open-{name}")] == []
    assert lab.page.locator(".lm-MenuBar-itemLabel", has_text="Nbgrader").count() == 0
    assert lab.page.request.get(f"{lab.address}/formgrader").status == 404


def test_a_notebook_runs(lab):
    lab.open("tiny/right.ipynb")
    lab.run_all()
    assert "3.0" in lab.output()


@pytest.mark.parametrize(("notebook", "failing"), [("right", 0), ("half_right", 1), ("wrong", 3)])
def test_validate_says_what_marking_will_say(lab, notebook, failing):
    lab.open(f"tiny/{notebook}.ipynb")
    said = lab.validate()
    assert said.count("The following cell failed:") == failing
    assert ("Success! Your notebook passes all the tests." in said) == (failing == 0)
