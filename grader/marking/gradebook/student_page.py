"""A student's page of one notebook: nbgrader's feedback with the student's name and contents by exercise.

nbgrader uses this exporter (`GenerateFeedback.exporter_class`). The page needs no external resources.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from nbconvert.exporters import HTMLExporter
from nbformat import NotebookNode
from nbgrader.api import Gradebook, MissingEntry
from pygments.formatters import HtmlFormatter
from traitlets.config import Config

from grader.course_files.local_time import format_local
from grader.marking.lateness import DAY_S
from grader.marking.outputs import FOR_INSTRUCTOR

HEADING = re.compile(r"^#{1,6}\s+(.+?)\s*$", re.MULTILINE)
WORTH = re.compile(r"\s*\(\d+(\.\d+)? points?\)$")
UNITS = (DAY_S, "days"), (3600.0, "hours"), (60.0, "minutes")
MARKS = str.maketrans("", "", "`*")


@dataclass(frozen=True)
class ContentsEntry:
    """A line of the contents. anchor: its target. earned, worth: points; None for a comment."""

    title: str
    anchor: str
    earned: float | None = None
    worth: float | None = None


class StudentPage(HTMLExporter):
    """Exports a marked notebook for its student."""

    @property
    def default_config(self) -> Config:
        """Its own template, independent of the configuration of nbgrader's pages."""
        places = [str(Path(__file__).parent / "templates")]
        config = Config({"StudentPage": {"template_name": "student_page", "extra_template_basedirs": places}})
        config.merge(super().default_config)
        return config

    def from_notebook_node(  # type: ignore[override]  # as all exporters that make text
        self, nb: NotebookNode, resources: dict[str, Any] | None = None, **kw: Any
    ) -> tuple[str, dict[str, Any]]:
        """Work like HTMLExporter. resources: nbgrader's, with student and assignment."""
        about = (resources or {})["nbgrader"]
        self.environment.globals["page"] = {
            "name": _name(about),
            "late": _late(about),
            "assignment": about["assignment"],
            "notebook": about["notebook"],
            "colors": HtmlFormatter().get_style_defs(".highlight"),  # of code
        }
        for cell in nb.cells:
            if "outputs" in cell:
                cell.outputs = [output for output in cell.outputs if not _for_instructor(output)]
        return super().from_notebook_node(nb, resources, **kw)

    def _preprocess(self, nb: NotebookNode, resources: dict[str, Any]) -> tuple[NotebookNode, dict[str, Any]]:
        """Work like HTMLExporter. nbgrader's preprocessors enter the scores; the contents need them."""
        nb, resources = super()._preprocess(nb, resources)  # type: ignore[no-untyped-call]
        self.environment.globals["page"]["contents"] = list(_contents(nb))
        return nb, resources


def _name(about: dict[str, Any]) -> str:
    """The student's id, with the name if the gradebook has one."""
    student = about["student"]
    try:
        with Gradebook(about["db_url"]) as book:
            known = book.find_student(student)
            name = " ".join(part for part in (known.first_name, known.last_name) if part)
    except MissingEntry:
        name = ""
    return f"{name} ({student})" if name not in ("", student) else student


def _late(about: dict[str, Any]) -> str:
    """Return how late it was handed in, or ""."""
    try:
        with Gradebook(about["db_url"]) as book:
            found = book.find_submission(about["assignment"], about["student"])
            seconds, due = found.total_seconds_late, found.duedate
    except MissingEntry:
        return ""
    return f"handed in {_duration(seconds)} after {format_local(due)}" if seconds else ""


def _duration(seconds: float) -> str:
    """In days; in hours or minutes if it is less than a day or an hour."""
    unit, name = next((each for each in UNITS if seconds >= each[0]), UNITS[-1])
    return f"{math.ceil(seconds / unit * 10) / 10:g} {name}"


def _for_instructor(output: NotebookNode) -> bool:
    return output.get("metadata", {}).get(FOR_INSTRUCTOR) is True


def _contents(notebook: NotebookNode) -> Iterator[ContentsEntry]:
    """Each cell that gives points, by the last heading above it."""
    title = ""
    for cell in notebook.cells:
        settings = cell.metadata.get("nbgrader", {})
        if cell.cell_type == "markdown" and not settings.get("solution"):
            found = HEADING.findall(cell.source)
            title = WORTH.sub("", found[-1]).translate(MARKS) if found else title
        name = settings.get("grade_id", "")
        if settings.get("grade") or settings.get("task"):
            yield ContentsEntry(title or name, name, settings.get("score"), settings.get("points"))
        if settings.get("comment") and (settings.get("solution") or settings.get("task")):
            yield ContentsEntry(f"Comment on {title or name}", f"comment-{name}")
