"""A prediction before a run: a question with answers to click, and afterwards what happened.

It needs no kernel: a script in the page shows the buttons, stores the answer, and compares it with the
outcome. JupyterLab with the course's extension also saves the answer, in the notebook's output and in its
folder. A prediction is not graded.
"""

from __future__ import annotations

import hashlib
import html
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

from IPython.display import display

from sim.notebook import in_notebook
from sim.view.javascript import packed, script

FILE = "predictions.json"  # in the notebook's folder: question -> answers, prediction, its day, what happened
LETTERS = "abcd"
SCRIPT = packed(script("prediction.js"))


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

    @property
    def predicted(self) -> str | None:
        """The letter of the saved prediction; None without one, and for other answers."""
        saved = _read(self._file).get(self.question, {})
        letter = saved.get("predicted") if isinstance(saved, dict) else None
        return letter if letter in [*self.answers] and saved.get("answers") == self.answers else None

    def code(self, letter: str) -> str:
        """Return the code of an answer, which does not show in the source which one is right."""
        return hashlib.sha256(f"{self.question}\n{letter}".encode()).hexdigest()[:6]

    def outcome(self, answer: str, details: str = "") -> None:
        """Display which answer was right beside the student's.

        answer: its letter or its code. details: more text, such as measured values.
        """
        letter = next((letter for letter in self.answers if answer in (letter, self.code(letter))), "")
        if not letter:
            codes = ", ".join(f"{letter} or {self.code(letter)}" for letter in self.answers)
            raise ValueError(f"outcome takes one of {codes}; it got {answer!r}.")
        if self.predicted:
            self._save(happened=letter, details=details)
        _show(self._outcome_html(letter, details), self._outcome_text(letter, details))

    def text(self) -> str:
        """Return the question and its answers as Markdown, with the student's prediction."""
        lines = [f"**Predict:** {self.question}", ""]
        for letter, answer in self.answers.items():
            chosen = letter == self.predicted
            lines.append(f"- **{letter}** {answer}" + (" ← **your prediction**" if chosen else ""))
        return "\n".join(lines)

    def show(self) -> None:
        """Display the question: with buttons where scripts run, elsewhere as a list."""
        answers = "".join(
            f'<li data-letter="{letter}"><b>{letter}</b> {_html(answer)}</li>'
            for letter, answer in self.answers.items()
        )
        question = f"<p><b>Predict:</b> {_html(self.question)}</p><ul>{answers}</ul>"
        _show(f'<div class="ros2-prediction"{self._data()}>{question}</div>', self.text())

    def _outcome_text(self, letter: str, details: str) -> str:
        happened = f"**What happened:** {self.answers[letter]} (**{letter}**)."
        if self.predicted == letter:
            happened += " You predicted that."
        elif self.predicted:
            happened += f" You predicted: {self.answers[self.predicted]} (**{self.predicted}**)."
        return f"{happened} {details}".rstrip()

    def _outcome_html(self, letter: str, details: str) -> str:
        happened = f"<p><b>What happened:</b> {_html(self.answers[letter])}</p>"
        more = f"<p>{_html(details)}</p>" if details else ""
        return f'<div class="ros2-outcome" data-happened="{letter}"{self._data()}>{happened}{more}</div>'

    def _data(self) -> str:
        """Return the attributes that the script in the page reads."""
        values = {"question": self.question, "answers": json.dumps(self.answers)}
        values["predicted"] = self.predicted or ""
        return "".join(f' data-{name}="{html.escape(value)}"' for name, value in values.items())

    def _save(self, **values: Any) -> None:
        saved = _read(self._file)
        saved[self.question] = {**saved[self.question], **values}
        text = json.dumps(saved, indent=1, ensure_ascii=False) + "\n"
        with suppress(OSError):  # in a folder that is read-only, the notebook's output alone has it
            self._file.write_text(text, encoding="utf-8")


def predict(question: str, **answers: str) -> Prediction:
    """Display a question about the next run, with two to four answers to click: a="...", b="..." and so on.

    After the run, call `outcome` of what it returns. Nothing waits for a click, and nothing is graded.
    Raises ValueError for other numbers or names of answers.
    """
    prediction = Prediction(question, answers, Path(FILE))
    prediction.show()
    return prediction


def _show(page: str, text: str) -> None:
    if in_notebook():
        page = f"{page}<script>{SCRIPT}</script>"
        display({"text/html": page, "text/markdown": text, "text/plain": text}, raw=True)
    else:
        print(text)


def _html(text: str) -> str:
    """Escape a text; `...` is code."""
    parts = html.escape(text).split("`")
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts))


def _read(file: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        saved = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(saved, dict):
            return saved
    return {}
