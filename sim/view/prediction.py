"""A prediction before a run: a question with answers to click, and afterwards what happened.

A clicked answer replaces the buttons in the cell's output, as text, and is saved in the notebook's
folder. It is not graded.
"""

from __future__ import annotations

import datetime
import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import anywidget
import traitlets
from IPython.display import DisplayHandle, display

from sim.notebook import in_notebook
from sim.view.javascript import script

FILE = "predictions.json"  # in the notebook's folder: question -> answers, prediction, its day, what happened
LETTERS = "abcd"


class Buttons(anywidget.AnyWidget):
    """The question with a button for each answer."""

    _esm = script("prediction.js")
    question = traitlets.Unicode().tag(sync=True)
    answers = traitlets.Dict().tag(sync=True)
    predicted = traitlets.Unicode(allow_none=True).tag(sync=True)

    def __init__(self, prediction: Prediction, on_click: Callable[[str], None]) -> None:
        traits = {"question": prediction.question, "answers": prediction.answers}
        super().__init__(**traits, predicted=prediction.predicted)
        self._on_click = on_click
        self.on_msg(self._on_message)

    def _on_message(self, _: Any, content: Any, buffers: Any) -> None:
        letter = content.get("answer") if isinstance(content, dict) else None
        if isinstance(letter, str) and letter in self.answers:  # pages are untrusted
            self._on_click(letter)

    def close(self) -> None:
        """Close the widget. Closing again does nothing."""
        self.layout.close()  # a separate widget that ipywidgets would retain
        super().close()


class Prediction:
    """A question about the next run, and the student's answer; created by `predict`."""

    def __init__(self, question: str, answers: dict[str, str], file: Path) -> None:
        letters = list(LETTERS[: len(answers)])
        if not 2 <= len(answers) <= len(LETTERS) or list(answers) != letters:
            raise ValueError(
                'predict takes a question and two to four answers, a="...", b="..." and so on;'
                f" it got {', '.join(answers) or 'none'}."
            )
        self.question, self.answers = question, answers
        self._file = file.resolve()
        earlier = _read(self._file).get(question, {})
        same = isinstance(earlier, dict) and earlier.get("answers") == answers
        self.predicted: str | None = earlier.get("predicted") if same else None
        self._buttons: Buttons | None = None
        self._display: DisplayHandle | None = None

    def show(self) -> None:
        """Display the question in the output of the running cell, with buttons where the page has widgets."""
        self._buttons = Buttons(self, self.choose)
        bundle = self._buttons._repr_mimebundle_()
        data = bundle[0] if isinstance(bundle, tuple) else bundle
        self._display = display({**data, **_bundle(self.text())}, raw=True, display_id=True)

    def choose(self, letter: str) -> None:
        """Predict this answer: show it in place of the buttons, and save it."""
        self.predicted = letter
        today = datetime.date.today().isoformat()
        self._save(answers=self.answers, predicted=letter, on=today)
        if self._display is not None:
            self._display.update(_bundle(self.text()), raw=True)
        if self._buttons is not None:
            self._buttons.close()
            self._buttons = None

    def outcome(self, letter: str, details: str = "") -> None:
        """Display which answer was right, and the student's. details: Markdown, such as measured values."""
        if letter not in self.answers:
            raise ValueError(f"outcome takes one of {', '.join(self.answers)}; it got {letter!r}.")
        if self.predicted is None:
            comparison = "You made no prediction."
        elif self.predicted == letter:
            comparison = "You predicted that."
        else:
            comparison = f"You predicted: {self.answers[self.predicted]} (**{self.predicted}**)."
        happened = f"**What happened:** {self.answers[letter]} (**{letter}**). {comparison}"
        if self.predicted is not None:
            self._save(happened=letter, details=details)
        _show(f"{happened} {details}".rstrip())

    def text(self) -> str:
        """The question and its answers as Markdown, with the student's prediction."""
        lines = [f"**Predict:** {self.question}", ""]
        for letter, answer in self.answers.items():
            chosen = letter == self.predicted
            lines.append(f"- **{letter}** {answer}" + (" ← **your prediction**" if chosen else ""))
        return "\n".join(lines)

    def _save(self, **values: Any) -> None:
        saved = _read(self._file)
        entry = saved.get(self.question)
        saved[self.question] = {**(entry if isinstance(entry, dict) else {}), **values}
        text = json.dumps(saved, indent=1, ensure_ascii=False) + "\n"
        with suppress(OSError):  # in a folder that is read-only, the notebook's output alone has it
            self._file.write_text(text, encoding="utf-8")


def predict(question: str, **answers: str) -> Prediction:
    """Display a question about the next run, with two to four answers to click: a="...", b="..." and so on.

    After the run, call `outcome` of what it returns. Nothing waits for a click, and nothing is graded.
    Raises ValueError for other numbers or names of answers.
    """
    prediction = Prediction(question, answers, Path(FILE))
    if in_notebook():
        prediction.show()
    else:
        print(prediction.text())
    return prediction


def _show(text: str) -> None:
    if in_notebook():
        display(_bundle(text), raw=True)
    else:
        print(text)


def _bundle(text: str) -> dict[str, str]:
    return {"text/markdown": text, "text/plain": text}


def _read(file: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        saved = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(saved, dict):
            return saved
    return {}
