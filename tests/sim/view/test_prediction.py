import json

import pytest

from sim.view import predict, prediction
from sim.view.prediction import FILE

QUESTION = "How far does it come?"
ANSWERS = {"a": "to the wall", "b": "half a meter", "c": "nowhere"}
WIDGET = "application/vnd.jupyter.widget-view+json"
CHOSEN = (
    f"**Predict:** {QUESTION}\n\n"
    "- **a** to the wall\n- **b** half a meter ← **your prediction**\n- **c** nowhere"
)


class Output:
    """What cells display, and what replaces it."""

    def __init__(self):
        self.shown = []

    def display(self, item, raw=False, display_id=False):
        self.shown.append(item)
        return self

    def update(self, item, raw):
        assert raw
        self.shown[0] = item


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def output(folder, monkeypatch):
    output = Output()
    monkeypatch.setattr(prediction, "display", output.display)
    monkeypatch.setattr(prediction, "in_notebook", lambda: True)
    return output


def saved(folder):
    return json.loads((folder / FILE).read_text("utf-8"))


def click(asked, letter):
    asked._buttons._on_message(None, {"answer": letter}, ())


def test_a_question_is_buttons_and_markdown_and_nothing_is_saved(output, folder):
    predict(QUESTION, **ANSWERS)
    (shown,) = output.shown
    assert WIDGET in shown
    text = f"**Predict:** {QUESTION}\n\n- **a** to the wall\n- **b** half a meter\n- **c** nowhere"
    assert shown["text/markdown"] == shown["text/plain"] == text
    assert not (folder / FILE).exists()


def test_a_click_replaces_the_buttons_by_text_and_is_saved(output, folder):
    asked = predict(QUESTION, **ANSWERS)
    click(asked, "b")
    assert output.shown == [{"text/markdown": CHOSEN, "text/plain": CHOSEN}]
    entry = saved(folder)[QUESTION]
    assert (entry["answers"], entry["predicted"]) == (ANSWERS, "b")


@pytest.mark.parametrize("content", ["b", {}, {"answer": "d"}, {"answer": ["b"]}, {"answer": None}])
def test_what_a_page_sends_that_is_no_answer_is_ignored(output, folder, content):
    asked = predict(QUESTION, **ANSWERS)
    asked._buttons._on_message(None, content, ())
    assert asked.predicted is None and not (folder / FILE).exists()


@pytest.mark.parametrize(
    ("letter", "text"),
    [
        (None, "**What happened:** nowhere (**c**). You made no prediction."),
        ("c", "**What happened:** nowhere (**c**). You predicted that."),
        ("b", "**What happened:** nowhere (**c**). You predicted: half a meter (**b**)."),
    ],
)
def test_the_outcome_is_compared_with_the_prediction(output, folder, letter, text):
    asked = predict(QUESTION, **ANSWERS)
    if letter:
        click(asked, letter)
    asked.outcome("c", "It measured 0.00 m.")
    whole = f"{text} It measured 0.00 m."
    assert output.shown[-1] == {"text/markdown": whole, "text/plain": whole}
    assert (folder / FILE).exists() == bool(letter)
    if letter:
        entry = saved(folder)[QUESTION]
        assert (entry["happened"], entry["details"]) == ("c", "It measured 0.00 m.")


def test_the_prediction_is_known_after_a_restart_and_can_be_changed(output, folder):
    click(predict(QUESTION, **ANSWERS), "a")
    output.shown.clear()
    again = predict(QUESTION, **ANSWERS)
    assert again.predicted == again._buttons.predicted == "a"
    click(again, "b")
    assert saved(folder)[QUESTION]["predicted"] == "b"


def test_a_prediction_for_other_answers_does_not_count(output, folder):
    click(predict(QUESTION, **ANSWERS), "a")
    assert predict(QUESTION, a="yes", b="no").predicted is None


@pytest.mark.parametrize("text", ["", "[]", '{"How far does it come?": 3}'])
def test_a_damaged_file_is_no_prediction(output, folder, text):
    (folder / FILE).write_text(text)
    asked = predict(QUESTION, **ANSWERS)
    assert asked.predicted is None
    click(asked, "a")
    assert saved(folder)[QUESTION]["predicted"] == "a"


def test_where_nothing_can_be_written_the_notebook_alone_has_it(output, folder):
    (folder / FILE).mkdir()
    asked = predict(QUESTION, **ANSWERS)
    click(asked, "b")
    assert asked.predicted == "b" and output.shown[0]["text/plain"] == CHOSEN


def test_outside_a_notebook_it_is_printed(folder, capsys):
    predict(QUESTION, **ANSWERS).outcome("a")
    printed = capsys.readouterr().out
    assert printed.startswith(f"**Predict:** {QUESTION}\n")
    assert printed.endswith("**What happened:** to the wall (**a**). You made no prediction.\n")


@pytest.mark.parametrize(
    ("answers", "got"),
    [
        ({}, "none"),
        ({"a": "yes"}, "a"),
        ({"b": "yes", "a": "no"}, "b, a"),
        (dict.fromkeys("abcde", "x"), "a, b, c, d, e"),
    ],
)
def test_wrong_answers_are_refused(folder, answers, got):
    with pytest.raises(ValueError) as refused:
        predict(QUESTION, **answers)
    expected = 'predict takes a question and two to four answers, a="...", b="..." and so on; it got '
    assert str(refused.value) == f"{expected}{got}."


def test_an_unknown_outcome_is_refused(folder):
    with pytest.raises(ValueError) as refused:
        predict(QUESTION, **ANSWERS).outcome("d")
    assert str(refused.value) == "outcome takes one of a, b, c; it got 'd'."
