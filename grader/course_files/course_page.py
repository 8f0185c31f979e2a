"""The course map as HTML: chapters, a card for each lesson, and the next notebook.

It has no scripts and loads nothing. All that its pictures show is also there as text or as a label for screen
readers; the links are in the order of the chapters. The style sheet is part of the page, and uses the colors
of the page around it.
"""

from __future__ import annotations

import html
import urllib.parse
from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path

from grader.course_files.course_notebooks import BRIDGE, Chapter, CoursePart, Notebook
from grader.page import format_points

RING = 100  # length of the ring, so that it can be given in percent
SAFE = " /=:;,.()-"  # characters of an SVG that an address in double quotes may contain
Text = Callable[[Path], str]


def course_page(
    chapters: Sequence[Chapter],
    following: Notebook | None,
    points: str,
    *,
    new_versions: Sequence[tuple[Path, Path]],
    updates: Sequence[str],
    name: Text,
    address: Text,
) -> str:
    """The page of a course.

    following: the next notebook. points: a sentence. new_versions: files that the student has changed, each
    with its new version. updates: a sentence for each notebook that the last update changed. name, address:
    give the path of a file in the course, and its relative URL.
    """
    style = files("grader.course_files").joinpath("course_page.css").read_text(encoding="utf-8")
    shown = "".join(_chapter(chapter, following, address) for chapter in chapters)
    return (
        f'<section class="ros2-course-map" aria-label="The course"><style>{style}</style>'
        f'<div class="top">{_next(following, address)}<p class="points">{html.escape(points)}</p></div>'
        f"{_news(new_versions, updates, name, address)}{shown}</section>"
    )


def _next(following: Notebook | None, address: Text) -> str:
    if following is None:
        return '<p class="next">You have done all of it.</p>'
    words = f"<span>Next</span><b>{html.escape(following.name)}</b>{_time(following)}"
    return f'<a class="next" href="{_quoted(address(following.path))}">{words}</a>'


def _news(versions: Sequence[tuple[Path, Path]], updates: Sequence[str], name: Text, address: Text) -> str:
    """A line for each file that has a new version, and for each update."""
    lines = ""
    for own, new in versions:
        first, second = _link(address(own), name(own)), _link(address(new), new.name)
        lines += f"<li>There is a new version of {first}. Yours is unchanged; the new one is {second}.</li>"
    lines += "".join(f"<li>{html.escape(sentence)}</li>" for sentence in updates)
    return f'<ul class="news" aria-label="New versions">{lines}</ul>' if lines else ""


def _chapter(chapter: Chapter, following: Notebook | None, address: Text) -> str:
    head = f"<h2>{html.escape(chapter.title)}</h2>" if chapter.title else ""
    about = f"<p>{html.escape(chapter.about)}</p>" if chapter.about else ""
    cards = "".join(_card(part, following, address) for part in chapter.parts)
    return f'{head}{about}<ul class="cards">{cards}</ul>'


def _card(part: CoursePart, following: Notebook | None, address: Text) -> str:
    lessons = [item for item in part.notebooks if not item.most]
    rows = [_lesson(item, address) for item in lessons]
    tasks = [item for item in part.notebooks if item.most]
    for item in tasks:
        rows.append(_exercises(item, f"Exercises {item.number}" if tasks[1:] else "Exercises", address))
    needs = "" if part.name == BRIDGE else next((item.needs for item in lessons if item.needs), "")
    after = f'<p class="needs">Before: {html.escape(needs)}</p>' if needs else ""
    now = following is not None and following in part.notebooks
    kind = " done" if all(item.done for item in part.notebooks) else " now" if now else ""
    return f'<li class="card{kind}">{_picture(part)}{"".join(rows)}{_pages(part, address)}{after}</li>'


def _pages(part: CoursePart, address: Text) -> str:
    """The pages of the bridge that are offered after this lesson."""
    links = [f"<li>{_link(address(page.path), page.heading)} {_time(page)}</li>" for page in part.pages]
    return f'<div class="pages">If you like, afterwards:<ul>{"".join(links)}</ul></div>' if links else ""


def _picture(part: CoursePart) -> str:
    """The goal of the lesson, as an image, so that no script in the file can run."""
    if not part.picture:
        return '<div class="picture"></div>'
    data = urllib.parse.quote(part.picture, safe=SAFE)
    return f'<img class="picture" alt="" src="data:image/svg+xml,{data}">'


def _lesson(item: Notebook, address: Text) -> str:
    state = "done" if item.done else f"{item.run} of {item.cells} cells run"
    share = 1.0 if item.done else item.run / max(item.cells, 1)
    link = _link(address(item.path), item.heading)
    return f'<div class="lesson">{_ring(share, state)}<h3>{link}</h3>{_time(item)}</div>'


def _ring(share: float, state: str) -> str:
    """A ring that is closed as far as the cells were run, with a tick in it when the lesson is done."""
    circle = '<circle cx="18" cy="18" r="15.9"'
    run = f'{circle} class="run" pathLength="{RING}" stroke-dasharray="{round(RING * share)} {RING}"/>'
    tick = '<path d="M12 18.5l4 4 8-9"/>' if state == "done" else ""
    label = f'role="img" aria-label="{state}"><title>{state}</title>'
    return f'<svg class="ring" viewBox="0 0 36 36" {label}{circle}/>{run if share else ""}{tick}</svg>'


def _exercises(item: Notebook, name: str, address: Text) -> str:
    share = 100 * item.points / item.most
    points = f"{format_points(item.points)} of {format_points(item.most)} points"
    until = f'<span class="due">due {html.escape(item.due)}</span>' if item.due else ""
    return (
        f'<div class="exercises">{_link(address(item.path), name)}{_time(item)}'
        f'<span class="bar" aria-hidden="true"><i style="width: {share:.0f}%"></i></span>'
        f"<span>{points}</span>{until}</div>"
    )


def _time(item: Notebook) -> str:
    return f'<span class="time">{html.escape(item.time)}</span>' if item.time else ""


def _link(address: str, text: str) -> str:
    return f'<a href="{_quoted(address)}">{html.escape(text)}</a>'


def _quoted(address: str) -> str:
    return html.escape(urllib.parse.quote(address))
