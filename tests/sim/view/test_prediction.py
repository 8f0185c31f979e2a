import json

import pytest

from sim.view import predict, prediction
from sim.view.prediction import FILE

QUESTION = "How far does `x` come, in <m>?"
ANSWERS = {"a": "to the wall", "b": "half a meter", "c": "nowhere"}
TEXT = f"**Predict:** {QUESTION}\n\n- **a** to the wall\n- **b** half a meter\n- **c** nowhere"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def shown(folder, monkeypatch):
    """What cells display."""
    found = []
    monkeypatch.setattr(prediction, "display", lambda bundle, raw: found.append(bundle))
    monkeypatch.setattr(prediction, "in_notebook", lambda: True)
    return found


def predicted(folder, letter, **more):
    """The page has saved this answer."""
    entry = {"answers": ANSWERS, "predicted": letter, "on": "2026-11-28", **more}
    (folder / FILE).write_text(json.dumps({QUESTION: entry, "another": {"predicted": "a"}}))


def test_a_question_is_a_list_that_a_script_turns_into_buttons(shown, folder):
    predict(QUESTION, **ANSWERS)
    (bundle,) = shown
    assert bundle["text/markdown"] == bundle["text/plain"] == TEXT
    page, script = bundle["text/html"].split("<script>")
    question = "How far does `x` come, in &lt;m&gt;?"
    assert page.startswith(f'<div class="ros2-prediction" data-question="{question}" data-answers="{{&quot;a')
    assert 'data-predicted=""><p><b>Predict:</b> How far does <code>x</code> come, in &lt;m&gt;?</p>' in page
    assert '<li data-letter="c"><b>c</b> nowhere</li></ul></div>' in page
    assert "DecompressionStream" in script
    assert not (folder / FILE).exists()


@pytest.mark.parametrize("answer", ["c", "code"])
@pytest.mark.parametrize(
    ("letter", "text"),
    [
        (None, "**What happened:** nowhere (**c**)."),
        ("c", "**What happened:** nowhere (**c**). You predicted that."),
        ("b", "**What happened:** nowhere (**c**). You predicted: half a meter (**b**)."),
    ],
)
def test_the_outcome_is_compared_with_the_prediction(shown, folder, letter, text, answer):
    asked = predict(QUESTION, **ANSWERS)
    if letter:
        predicted(folder, letter)
    asked.outcome(asked.code("c") if answer == "code" else answer, "It measured `0.00` m.")
    bundle = shown[-1]
    assert bundle["text/markdown"] == bundle["text/plain"] == f"{text} It measured `0.00` m."
    page = bundle["text/html"].split("<script>")[0]
    assert page.startswith('<div class="ros2-outcome" data-happened="c" data-question=')
    assert f'data-predicted="{letter or ""}"><p><b>What happened:</b> nowhere</p>' in page
    assert page.endswith("<p>It measured <code>0.00</code> m.</p></div>")
    if letter:
        saved = json.loads((folder / FILE).read_text("utf-8"))
        assert (saved[QUESTION]["happened"], saved[QUESTION]["details"]) == ("c", "It measured `0.00` m.")
        assert saved["another"] == {"predicted": "a"}
    else:
        assert not (folder / FILE).exists()


def test_the_codes_of_two_questions_differ(folder):
    codes = {predict(question, **ANSWERS).code(letter) for question in ("one", "two") for letter in ANSWERS}
    assert len(codes) == 6 and not codes & set(ANSWERS)


def test_the_prediction_is_known_after_a_restart(shown, folder):
    predicted(folder, "b")
    again = predict(QUESTION, **ANSWERS)
    assert again.predicted == "b" and 'data-predicted="b"' in shown[0]["text/html"]
    assert shown[0]["text/plain"] == TEXT.replace("half a meter", "half a meter ← **your prediction**")


def test_a_prediction_for_other_answers_does_not_count(folder):
    predicted(folder, "a")
    assert predict(QUESTION, a="yes", b="no").predicted is None


@pytest.mark.parametrize("text", ["", "[]", *(json.dumps({QUESTION: x}) for x in (3, {"predicted": ["a"]}))])
def test_a_damaged_file_is_no_prediction(shown, folder, text):
    (folder / FILE).write_text(text)
    asked = predict(QUESTION, **ANSWERS)
    assert asked.predicted is None
    asked.outcome("a")
    assert (folder / FILE).read_text() == text


def test_where_nothing_can_be_written_the_page_alone_has_it(shown, folder, monkeypatch):
    predicted(folder, "b")
    asked = predict(QUESTION, **ANSWERS)

    def fail(*_, **__):
        raise OSError("read-only")

    monkeypatch.setattr("pathlib.Path.write_text", fail)
    asked.outcome("b")
    assert shown[-1]["text/plain"] == "**What happened:** half a meter (**b**). You predicted that."


def test_outside_a_notebook_it_is_printed(folder, capsys):
    predict(QUESTION, **ANSWERS).outcome("a")
    assert capsys.readouterr().out == f"{TEXT}\n**What happened:** to the wall (**a**).\n"


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


def test_an_unknown_outcome_is_refused_with_the_codes(folder):
    asked = predict("Does it stop?", a="yes", b="no")
    with pytest.raises(ValueError) as refused:
        asked.outcome("d")
    assert str(refused.value) == "outcome takes one of a or b99b29, b or f6943e; it got 'd'."
