"""The home page of the web site: for whom the course is, a robot that drives, and chapters with covers."""
import base64
import html
import importlib
import json
import re
import sys
import urllib.parse
from importlib.resources import files
from pathlib import Path
from typing import Any

from grader.course_files.course_map import course_map
from grader.course_files.course_notebooks import CHAPTERS, Chapter, CoursePart, read_text
from grader.course_files.course_page import SAFE
from grader.exercises import navigator, nodes
from sim import Recording, run
from sim.course_folders import COURSE
from sim.view import animate, plot_graph, plot_signal

MINUTES = re.compile(r"(\d+) minutes")


# A student's program, which counts once a second; the task is twice a second.
COUNTER = """
from rclpy.node import Node

class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.count += 1
        self.get_logger().info(f"Count: {self.count}")
"""


def home_page(root: Path) -> str:
    """The page as HTML. root: the folder with course/ and exercises/."""
    drive = _drive()
    program: dict[str, Any] = {}
    exec(COUNTER, program)
    graph = plot_graph(drive)
    parts = {
        "robot": animate(drive, speed=4).html,
        "graph": base64.b64encode(graph._repr_png_()[0]).decode(),
        "graph_words": html.escape(graph.description),
        "plot": plot_signal(drive, "/cmd_vel", "linear.x", "angular.z")._repr_mimebundle_()["text/html"],
        "score": nodes.counter.grade(program["Counter"])._repr_html_(),  # type: ignore[attr-defined]
        "chapters": "".join(_chapter(chapter, root) for chapter in course_map(root / "course").chapters),
    }
    template = files("grader.marking.release").joinpath("site_home.html").read_text(encoding="utf-8")
    for name, text in parts.items():
        template = template.replace(f"{{{name}}}", text)
    return template


def _drive() -> Recording:
    """Lesson 6's navigator on its way around a box that the map does not have."""
    sys.path.insert(0, str(COURSE / "course" / "06_navigator"))
    try:
        whole = importlib.import_module("whole")
    finally:
        del sys.path[0]
    room, known = navigator.blocked(seed=5)
    client = navigator.made_for(navigator.GoalClient, goal=room.goal)
    programs = *navigator.bringup(room, known), client, whole.main
    return run(*programs, world=room, seconds=19, quiet=True)


def _chapter(chapter: Chapter, root: Path) -> str:
    """A chapter with its hours, what one can do afterwards, and a card for each part."""
    minutes = sum(_minutes(item.time) for part in chapter.parts for item in part.notebooks if not item.most)
    hours = f" About {round(minutes / 60)} hours of lessons, and the exercises." if minutes >= 60 else ""
    data = json.loads(read_text(root / "course" / CHAPTERS) or "[]")
    after = next((each.get("after", "") for each in data if each["title"] == chapter.title), "")
    head = f"<h3>{html.escape(chapter.title)}</h3><p>{html.escape(f'{chapter.about}{hours} {after}')}</p>"
    cards = "".join(_card(part, root) for part in chapter.parts)
    return f'{head if chapter.title else ""}<ul class="parts">{cards}</ul>'


def _card(part: CoursePart, root: Path) -> str:
    lessons = [item for item in part.notebooks if not item.most]
    cover = f'<img alt="" src="data:image/svg+xml,{urllib.parse.quote(part.picture, safe=SAFE)}">'
    rows = ""
    for item in lessons:
        address = item.path.relative_to(root).with_suffix(".html").as_posix()
        rows += f'<a href="{address}">{html.escape(item.heading)}</a><span>{html.escape(item.time)}</span>'
    return f"<li>{cover if part.picture else ''}{rows}</li>"


def _minutes(time: str) -> int:
    return int((MINUTES.findall(time) or [0])[0])
