"""A student clicks a prediction, in light and dark, wide and narrow; the answer is in the saved notebook."""

import json

import pytest

from tests.browser.lab import write_notebook

pytestmark = pytest.mark.browser
NAME = "pictures/predict.ipynb"
ASK = "from sim.view import predict\nguess = predict('Does `x` *fall*?', a='yes, at once', b='no')"
TEXT = "**Predict:** Does `x` *fall*?\n\n- **a** yes, at once ← **your prediction**\n- **b** no"


def test_a_click_is_saved_as_text_and_compared_with_what_happened(students_folder, open_lab):
    write_notebook(students_folder / NAME, ASK, "guess.outcome('b')")
    with open_lab(NAME) as lab:
        lab.run_cell(0)
        buttons = lab.cell(0).locator(".ros2-prediction button")
        assert buttons.all_inner_texts() == ["a\nyes, at once", "b\nno"]
        lab.screenshot("prediction")
        with lab.narrow_and_dark():
            buttons.first.wait_for()
            lab.screenshot("prediction-narrow-dark")
            assert lab.cell(0).evaluate("cell => cell.scrollWidth <= cell.clientWidth")
        buttons.first.click()
        lab.cell(0).locator("li", has_text="your prediction").wait_for()
        lab.run_cell(1)
        lab.save()
    cells = json.loads((students_folder / NAME).read_text("utf-8"))["cells"]
    shown = [["".join(output["data"]["text/markdown"]) for output in cell["outputs"]] for cell in cells]
    assert shown == [[TEXT], ["**What happened:** no (**b**). You predicted: yes, at once (**a**)."]]
    saved = json.loads((students_folder / "pictures/predictions.json").read_text("utf-8"))
    assert saved["Does `x` *fall*?"]["predicted"] == "a"
