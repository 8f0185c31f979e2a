"""A student's page of one notebook: nbgrader's feedback with the student's name and contents by exercise.

nbgrader makes it with this exporter (`GenerateFeedback.exporter_class`). It has all that it shows in it.
"""

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

from grader.marking.outputs import FOR_INSTRUCTOR

HEADING = re.compile(r"^#{1,6}\s+(.+?)\s*$", re.MULTILINE)
WORTH = re.compile(r"\s*\(\d+(\.\d+)? points?\)$")
MARKS = str.maketrans("", "", "`*")


@dataclass(frozen=True)
class Part:
    """A line of the contents. anchor: where it leads. earned, worth: points; None for a comment."""

    title: str
    anchor: str
    earned: float | None = None
    worth: float | None = None


class StudentPage(HTMLExporter):
    """Exports a marked notebook for the student whose it is."""

    @property
    def default_config(self) -> Config:
        """Its own template, whatever the configuration of nbgrader's pages says."""
        places = [str(Path(__file__).parent / "templates")]
        config = Config({"StudentPage": {"template_name": "student_page", "extra_template_basedirs": places}})
        config.merge(super().default_config)
        return config

    def from_notebook_node(
        self, nb: NotebookNode, resources: dict[str, Any] | None = None, **kw: Any
    ) -> tuple[str, dict[str, Any]]:
        """As HTMLExporter. resources: nbgrader's, which say whose notebook it is."""
        about = (resources or {})["nbgrader"]
        self.environment.globals["page"] = {
            "name": _name(about),
            "assignment": about["assignment"],
            "notebook": about["notebook"],
            "colours": HtmlFormatter().get_style_defs(".highlight"),  # of code
        }
        for cell in nb.cells:
            if "outputs" in cell:
                cell.outputs = [output for output in cell.outputs if not _for_instructor(output)]
        return super().from_notebook_node(nb, resources, **kw)

    def _preprocess(self, nb: NotebookNode, resources: dict[str, Any]) -> tuple[NotebookNode, dict[str, Any]]:
        """As HTMLExporter. In here nbgrader enters the scores; the contents come after it."""
        nb, resources = super()._preprocess(nb, resources)
        self.environment.globals["page"]["parts"] = list(_parts(nb))
        return nb, resources


def _name(about: dict[str, Any]) -> str:
    """The student's name with the id, as far as the gradebook has one."""
    student = about["student"]
    try:
        with Gradebook(about["db_url"]) as book:
            known = book.find_student(student)
            name = " ".join(part for part in (known.first_name, known.last_name) if part)
    except MissingEntry:
        name = ""
    return f"{name} ({student})" if name not in ("", student) else student


def _for_instructor(output: NotebookNode) -> bool:
    return output.get("metadata", {}).get(FOR_INSTRUCTOR) is True


def _parts(notebook: NotebookNode) -> Iterator[Part]:
    """Each cell that gives points, by the last heading above it."""
    title = ""
    for cell in notebook.cells:
        told = cell.metadata.get("nbgrader", {})
        if cell.cell_type == "markdown" and not told.get("solution"):
            found = HEADING.findall(cell.source)
            title = WORTH.sub("", found[-1]).translate(MARKS) if found else title
        if told.get("grade") or told.get("task"):
            yield Part(title or told["grade_id"], told["grade_id"], told.get("score"), told.get("points"))
        if told.get("comment") and (told.get("solution") or told.get("task")):
            yield Part(f"Comment on {title or told['grade_id']}", f"comment-{told['grade_id']}")
