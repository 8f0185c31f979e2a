"""The course map: all notebooks with their time, progress and points, and the next one.

Everything is read from the files of the course; no other state is stored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby
from pathlib import Path

from grader.course_files.course_notebooks import (
    BRIDGE,
    CHAPTERS,
    DUE,
    PICTURE,
    UPDATED,
    Chapter,
    CoursePart,
    Notebook,
    new_versions,
    part_of,
    picture_of,
    read_chapters,
    read_due_dates,
    read_notebooks,
    read_offers,
    read_text,
)
from grader.course_files.course_page import course_page
from grader.course_files.local_time import format_local
from grader.page import format_points

REST = "More"  # title of the chapter of what chapters.json does not list


class CourseMap:
    """The course map: in Jupyter a page with links, in a terminal lines of text; see `course_map`."""

    def __init__(self, root: Path, here: Path) -> None:
        self._root, self._here = root, here
        due = {name: format_local(when) for name, when in read_due_dates(root / "course" / DUE).items()}
        found = read_notebooks(root)
        self.notebooks = [replace(item, due=due.get(item.path.parent.name, "")) for item in found]
        self._new_versions = new_versions(root)
        self._updates = read_text(root / UPDATED).splitlines()

    @property
    def next(self) -> Notebook | None:
        """The first notebook that is not done; None if all are.

        A lesson before the last one that is done counts as read, even if some of its cells were not run.
        """
        begun = max((i for i, item in enumerate(self.notebooks) if item.done or item.points), default=-1)
        rest = (item for i, item in enumerate(self.notebooks) if not item.done and (item.most or i > begun))
        return next(rest, None)

    @property
    def chapters(self) -> list[Chapter]:
        """The chapters that `course/chapters.json` lists; what it doesn't list is in a last one."""
        parts = {part.name: part for part in self._parts()}
        found = []
        for title, about, names in read_chapters(self._root / "course" / CHAPTERS):
            chosen = tuple(parts.pop(name) for name in names if name in parts)
            found += [Chapter(title, about, chosen)] if chosen else []
        return [*found, *([Chapter(REST if found else "", "", tuple(parts.values()))] if parts else [])]

    def __repr__(self) -> str:
        lines = [f"{item.name}, {self._state(item)}" for item in self.notebooks]
        lines += [f"New version: {self._relative(new)}" for _, new in self._new_versions]
        lines += self._updates
        return "\n".join([*lines, self._points(), *([f"Next: {self.next.name}"] if self.next else [])])

    def _repr_html_(self) -> str:
        return course_page(
            self.chapters,
            self.next,
            self._points(),
            new_versions=self._new_versions,
            updates=self._updates,
            name=self._relative,
            address=self._address,
        )

    def _points(self) -> str:
        """A sentence on the points of all assignments."""
        earned, most = (sum(getattr(item, name) for item in self.notebooks) for name in ("points", "most"))
        return f"Your points so far: {format_points(earned)} of {format_points(most)}"

    def _relative(self, path: Path) -> str:
        """The path of a file in the course's folder, with slashes."""
        return path.relative_to(self._root).as_posix()

    def _address(self, path: Path) -> str:
        """The relative URL of a file from where the map is shown."""
        return "../" * len(self._here.relative_to(self._root).parts) + self._relative(path)

    def _state(self, item: Notebook) -> str:
        if item.most:
            until = f", due {item.due}" if item.due else ""
            return f"{format_points(item.points)} of {format_points(item.most)} points{until}"
        return "✔ done" if item.done else f"{item.run} of {item.cells} cells run"

    def _parts(self) -> Iterator[CoursePart]:
        """The parts in the order of the course."""
        offers = read_offers(self._root / "course" / CHAPTERS)
        pages = {item.path.stem: item for item in self.notebooks if item.path.parent.name == BRIDGE}
        for _, notebooks in groupby(self.notebooks, key=lambda item: part_of(item.path.parent.name)):
            items = tuple(notebooks)
            name = items[0].path.parent.name
            offered = tuple(pages[page] for page in offers.get(name, ()) if page in pages)
            yield CoursePart(name, items, self._picture(name, items), offered)

    def _picture(self, name: str, items: tuple[Notebook, ...]) -> str:
        """The SVG of a part's goal; of several lessons, that of the first one that is not done."""
        lessons = [item for item in items if not item.most]
        following = [item for item in lessons if not item.done] or lessons
        shown = [read_text(picture_of(item.path)) for item in following[:1]]
        return "".join(shown) or read_text(self._root / "course" / name / PICTURE)


def course_map(here: Path | str | None = None) -> CourseMap:
    """The map of the course that contains the folder `here`, by default the notebook's folder.

    Raises LookupError if it is not in a course.
    """
    here = Path(here or Path.cwd()).resolve()
    for root in (here, *here.parents):
        if (root / "course").is_dir() and (root / "exercises").is_dir():
            return CourseMap(root, here)
    raise LookupError(f"{here} is not in the course: expected a folder with course/ and exercises/ above it.")
