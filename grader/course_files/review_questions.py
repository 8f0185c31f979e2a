"""Questions from earlier lessons for the start page: the student's own predictions, some days later.

Each notebook's folder has its predictions in predictions.json, which `sim.view.predict` writes.
"""

from __future__ import annotations

import ast
import datetime
import html
import json
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

FILE = "predictions.json"
INTERVALS = (1, 3, 7, 14, 30)  # days after a prediction on which it is asked again first of all
MOST = 3


@dataclass(frozen=True)
class ReviewQuestion:
    """A prediction whose outcome is known.

    days: since it was made. lesson: the name of its folder. notebook: the name of the file that asks it.
    """

    lesson: str
    question: str
    answers: dict[str, str]
    predicted: str
    happened: str
    days: int
    notebook: str = "lesson.ipynb"

    @property
    def urgency(self) -> tuple[bool, bool, int]:
        """Sorts by what is asked first: on its day, wrong before right, older ones first."""
        return self.days not in INTERVALS, self.predicted == self.happened, -self.days


def review_questions(course: Path, today: datetime.date) -> list[ReviewQuestion]:
    """At most three questions for this day, from the predictions that the lessons in `course` saved."""
    chosen = sorted(_all(course, today), key=lambda item: item.urgency)[:MOST]
    return [replace(item, notebook=_notebook_of(item, course)) for item in chosen]


def review_html(questions: list[ReviewQuestion]) -> str:
    """The questions as HTML; each opens to show what happened. "" if there are none."""
    if not questions:
        return ""
    return f"<h2>Do you remember?</h2>\n{''.join(map(_details, questions))}"


def _details(item: ReviewQuestion) -> str:
    answers = "".join(f"<li>{_text(letter)} {_text(answer)}</li>" for letter, answer in item.answers.items())
    address = f"{item.lesson}/{item.notebook}"
    return (
        f"<details><summary>{_text(item.question)}</summary><ul>{answers}</ul>"
        f"<details><summary>What happened</summary><p><b>{_text(item.happened)}</b>"
        f" {_text(item.answers[item.happened])}. You predicted {_text(item.predicted)}, in"
        f' <a href="{html.escape(address)}">{html.escape(item.lesson)}</a>.</p></details></details>\n'
    )


def _notebook_of(item: ReviewQuestion, course: Path) -> str:
    """The name of the notebook that asks the question: a folder may have several."""
    for path in sorted((course / item.lesson).glob("*.ipynb")):
        with suppress(OSError, ValueError, TypeError, KeyError, SyntaxError):
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            sources = ["".join(cell["source"]) for cell in cells]
            nodes = [node for text in sources if "predict(" in text for node in ast.walk(ast.parse(text))]
            if any(isinstance(node, ast.Constant) and node.value == item.question for node in nodes):
                return path.name
    return item.notebook


def _text(markdown: str) -> str:
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(markdown))


def _all(course: Path, today: datetime.date) -> Iterator[ReviewQuestion]:
    for file in sorted(course.glob(f"*/{FILE}")):
        saved = {}
        with suppress(OSError, ValueError):
            saved = json.loads(file.read_text(encoding="utf-8"))
        for question, entry in saved.items() if isinstance(saved, dict) else ():
            with suppress(KeyError, TypeError, ValueError, AttributeError):  # a damaged entry is left out
                answers = {str(letter): str(answer) for letter, answer in entry["answers"].items()}
                days = (today - datetime.date.fromisoformat(entry["on"])).days
                if days >= 1 and {entry["predicted"], entry["happened"]} <= set(answers):
                    given = (entry["predicted"], entry["happened"], days)
                    yield ReviewQuestion(file.parent.name, str(question), answers, *given)
