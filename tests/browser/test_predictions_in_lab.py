"""A student clicks a prediction, in light and dark, wide and narrow; it is there the next day."""

import json

import nbformat
import pytest

from tests.browser.lab import write_notebook
from tests.patience import until

pytestmark = pytest.mark.browser
NAME = "pictures/predict.ipynb"
ASK = "from sim.view import predict\nguess = predict('Does `x` fall?', a='yes, at `once`', b='no')"
SAVED = "Your prediction is saved. Run the next cells to see what happens."


def predicted(file):
    """The saved prediction; None while Jupyter's server is still writing the file."""
    try:
        return json.loads(file.read_text("utf-8"))["Does `x` fall?"]["predicted"]
    except json.JSONDecodeError:
        return None


def test_a_click_is_saved_compared_with_what_happened_and_there_the_next_day(students_folder, open_lab):
    write_notebook(students_folder / NAME, ASK, "guess.outcome('b')")
    file = students_folder / "pictures/predictions.json"
    with open_lab(NAME) as lab:
        lab.run_cell(0)
        buttons = lab.cell(0).locator(".ros2-prediction button")
        buttons.first.wait_for()
        assert buttons.all_inner_texts() == ["a\nyes, at once", "b\nno"]
        lab.screenshot("prediction")
        with lab.narrow_and_dark():
            buttons.first.wait_for()
            lab.screenshot("prediction-narrow-dark")
            assert lab.cell(0).evaluate("cell => cell.scrollWidth <= cell.clientWidth")
        buttons.first.click()
        lab.cell(0).locator("[role=status]", has_text=SAVED).wait_for()
        until(file.exists, "the saved prediction")
        until(lambda: predicted(file) == "a", "the answer")
        lab.run_cell(1)
        lab.cell(1).locator(".ros2-outcome.other").wait_for()
        texts = ["You predicted:\nyes, at once", "What happened:\nno"]
        assert lab.cell(1).locator(".ros2-outcome p").all_inner_texts() == texts
        lab.screenshot("prediction-outcome")
        lab.save()
    entry = json.loads(file.read_text("utf-8"))["Does `x` fall?"]
    assert (entry["predicted"], entry["happened"]) == ("a", "b")
    saved = nbformat.read(students_folder / NAME, 4)
    (card,) = [output.data["text/html"] for output in saved.cells[0].outputs if "data" in output]
    assert 'data-predicted="a"' in card
    with open_lab(NAME) as lab:  # with a new kernel that has run nothing
        chosen = lab.cell(0).locator("button[aria-pressed=true]")
        assert chosen.all_inner_texts() == ["a\nyes, at once"]
        assert lab.cell(1).locator(".ros2-outcome p").all_inner_texts() == texts


def test_a_prediction_can_be_made_without_a_kernel_that_knows_it(students_folder, open_lab):
    name = "pictures/tomorrow.ipynb"
    write_notebook(students_folder / name, ASK.replace("fall", "rise"), "guess.outcome('b')")
    with open_lab(name) as lab:
        lab.run_cell(0)
        lab.save()
    with open_lab(name) as lab:
        lab.cell(0).locator("button", has_text="no").click()
        lab.cell(0).locator("[role=status]", has_text=SAVED).wait_for()
        lab.run_cell(0)
        chosen = lab.cell(0).locator("button[aria-pressed=true]")
        chosen.wait_for()
        assert chosen.all_inner_texts() == ["b\nno"]
        lab.run_cell(1)
        lab.cell(1).locator(".ros2-outcome.right", has_text="That's right.").wait_for()


SLIDER = """
from ipywidgets import IntSlider, interact
@interact(steps=IntSlider(3, min=1, max=9))
def show(steps):
    print('steps:', steps)
"""


def test_a_slider_shows_its_last_state_the_next_day_and_says_what_to_do(students_folder, open_lab):
    name = "pictures/slider.ipynb"
    write_notebook(students_folder / name, SLIDER)
    with open_lab(name) as lab:
        lab.run_cell(0)
        lab.cell(0).get_by_text("steps: 3").wait_for()
        lab.wait("() => !document.querySelector('.jupyter-widgets-disconnected')")
        lab.save()
        assert "steps: 3" in (students_folder / name).read_text(encoding="utf-8")
    lab.page.goto("about:blank")  # the next day JupyterLab begins anew, and knows of no widget
    with open_lab(name) as lab:
        lab.cell(0).get_by_text("steps: 3").wait_for()
        lab.screenshot("slider-next-day")
        before = "getComputedStyle(document.querySelector('.widget-interact'), '::before').content"
        assert lab.page.evaluate(before) == '"Run this cell again to move the sliders."'
        lab.save()  # the kernel has no widgets, and those of the notebook stay in it
    lab.page.goto("about:blank")
    with open_lab(name) as lab:
        lab.cell(0).get_by_text("steps: 3").wait_for()
        lab.run_cell(0)
        lab.wait(f"() => {before} === 'none'")
