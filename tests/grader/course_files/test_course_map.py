import json
import re
import time
from pathlib import Path

import pytest

from grader import course_map

ROOT = Path(__file__).parents[3]
POINTS = {"nbgrader": {"grade": True, "points": 8}}


def code(*, run=None, metadata=None, result=None):
    outputs = [{"output_type": "execute_result", "data": {"text/plain": [result]}}] if result else []
    return {
        "cell_type": "code",
        "source": ["1"],
        "execution_count": run,
        "metadata": metadata or {},
        "outputs": outputs,
    }


def write(path, title, *cells):
    path.parent.mkdir(parents=True, exist_ok=True)
    words = "**Time:** about\nan hour. **Before you begin:** Python & `lesson` 0. More is in the glossary."
    head = {"cell_type": "markdown", "metadata": {}, "source": [f"# {title}\n\n", words]}
    path.write_text(json.dumps({"cells": [head, *cells]}))


@pytest.fixture
def course(tmp_path):
    write(tmp_path / "course/01_nodes/lesson.ipynb", "Lesson 1: nodes", *[code(run=n + 1) for n in range(10)])
    checks = [code(run=3, metadata=POINTS, result="6.5"), code(metadata=POINTS)]
    write(tmp_path / "exercises/01_nodes/nodes.ipynb", "Assignment 1: nodes", *checks)
    write(tmp_path / "course/02_topics/lesson.ipynb", "Lesson 2: <topics>", code(run=1), code())
    (tmp_path / "course/02_topics/broken.ipynb").write_text("<<<<<<<")
    write(tmp_path / "course/02_topics/lesson-new.ipynb", "Lesson 2: a new version", code())
    return tmp_path


def test_the_map_has_times_what_is_done_the_points_and_the_next_step(course):
    assert repr(course_map(course / "course")).splitlines() == [
        "1 nodes (lesson), ✔ done",
        "1 nodes (exercises), 6.5 of 16 points",
        "2 <topics> (lesson), 1 of 2 cells run",
        "New version: course/02_topics/lesson-new.ipynb",
        "Your points so far: 6.5 of 16",
        "Next: 1 nodes (exercises)",
    ]
    first = course_map(course).notebooks[0]
    assert (first.time, first.needs) == ("about an hour", "Python & lesson 0")


def test_as_html_it_has_links_from_where_it_is_shown(course):
    page = course_map(course / "course")._repr_html_()
    next_step = "<span>Next</span><b>1 nodes (exercises)</b><span class=\"time\">about an hour</span></a>"
    assert f'<a class="next" href="../exercises/01_nodes/nodes.ipynb">{next_step}' in page
    assert '<h3><a href="../course/02_topics/lesson.ipynb">2 &lt;topics&gt;</a></h3>' in page
    assert "Before: Python &amp; lesson 0</p>" in page and "Your points so far: 6.5 of 16</p>" in page
    assert 'href="exercises/01_nodes/nodes.ipynb"' in course_map(course)._repr_html_()


def test_the_page_shows_progress_as_pictures_and_as_text(course):
    page = course_map(course)._repr_html_()
    done, half = page.split('<li class="card')[1:]
    assert 'aria-label="done"' in done and "stroke-dasharray=\"100 100\"" in done
    assert '<i style="width: 41%"></i>' in done and "<span>6.5 of 16 points</span>" in done
    assert done.startswith(" now")
    assert 'aria-label="1 of 2 cells run"' in half and "stroke-dasharray=\"50 100\"" in half


def test_chapters_are_those_of_the_file_and_the_rest_comes_last(course):
    assert [chapter.title for chapter in course_map(course).chapters] == [""]
    listed = [
        {"title": "Empty", "about": "", "parts": ["05_sensing"]},
        {"title": "See & move", "about": "Both.", "parts": ["02_topics"]},
    ]
    (course / "course/chapters.json").write_text(json.dumps(listed))
    shown = [(each.title, [part.name for part in each.parts]) for each in course_map(course).chapters]
    assert shown == [("See & move", ["02_topics"]), ("More", ["01_nodes"])]
    assert "<h2>See &amp; move</h2><p>Both.</p>" in course_map(course)._repr_html_()
    (course / "course/chapters.json").write_text('{"title": 1}')
    assert [chapter.title for chapter in course_map(course).chapters] == [""]


def test_the_pages_of_the_bridge_come_after_the_lessons_in_one_part(course):
    write(course / "course/bridge/02_gazebo.ipynb", "Bridge 2: in Gazebo", code(run=1))
    write(course / "course/bridge/01_ros1.ipynb", "Bridge 1: ROS 1", code())
    write(course / "course/bridge/gazebo.ipynb", "Not a page", code())
    found = course_map(course)
    assert repr(found).splitlines()[3:5] == [
        "B1 ROS 1 (page), 0 of 1 cells run",
        "B2 in Gazebo (page), ✔ done",
    ]
    assert [part.name for part in found.chapters[0].parts] == ["01_nodes", "02_topics", "bridge"]
    card = found._repr_html_().split('<li class="card')[-1]
    assert '<h3><a href="course/bridge/02_gazebo.ipynb">B2 In Gazebo</a></h3>' in card
    assert "Before:" not in card, "each page needs something else"


def test_a_card_offers_the_pages_that_can_be_read_after_its_lesson(course):
    write(course / "course/bridge/02_gazebo.ipynb", "Bridge 2: in <Gazebo>", code())
    listed = {"title": "See", "about": "", "parts": ["02_topics"], "pages": {"02_topics": ["02_gazebo", "no_page"]}}
    (course / "course/chapters.json").write_text(json.dumps([listed]))
    link = '<a href="course/bridge/02_gazebo.ipynb">B2 In &lt;Gazebo&gt;</a> <span class="time">about an hour</span>'
    page = course_map(course)._repr_html_()
    assert page.count(f'<div class="pages">If you like, afterwards:<ul><li>{link}</li></ul></div>') == 1
    for broken in ('{"pages": 1}', '[{"pages": [1]}]', "[1]"):
        (course / "course/chapters.json").write_text(broken)
        assert 'class="pages"' not in course_map(course)._repr_html_()


def test_a_lesson_with_two_notebooks_is_one_card_with_both(course):
    write(course / "course/02_topics/lesson.ipynb", "Lesson 2a: topics", code(run=1))
    write(course / "course/02_topics/driving.ipynb", "Lesson 2b: topics that drive", code())
    (course / "course/02_topics/goal.svg").write_text("<svg>first</svg>")
    (course / "course/02_topics/driving.svg").write_text("<svg>second</svg>")
    found = course_map(course)
    assert repr(found).splitlines()[2:4] == [
        "2a topics (lesson), ✔ done",
        "2b topics that drive (lesson), 0 of 1 cells run",
    ]
    assert [part.picture for part in found.chapters[0].parts] == ["", "<svg>second</svg>"]
    titles = re.findall(r'<h3><a href="course/02_topics/(.*?)">(.*?)</a></h3>', found._repr_html_())
    assert titles == [("lesson.ipynb", "2a Topics"), ("driving.ipynb", "2b Topics that drive")]
    write(course / "course/02_topics/lesson.ipynb", "Lesson 2a: topics", code())
    assert course_map(course).chapters[0].parts[1].picture == "<svg>first</svg>"


def test_several_assignments_of_a_lesson_are_in_its_card_each_with_its_date(course):
    write(course / "exercises/01b_lamps/lamps.ipynb", "Assignment 1b: lamps", code(metadata=POINTS))
    write(course / "exercises/01_nodes/nodes.ipynb", "Assignment 1a: nodes", code(metadata=POINTS))
    (course / "course/due.json").write_text('{"01b_lamps": "2026-12-01T17:00:00"}')
    found = course_map(course)
    first, second, third, *_ = repr(found).splitlines()
    assert (first, second) == ("1 nodes (lesson), ✔ done", "1a nodes (exercises), 0 of 8 points")
    assert third.startswith("1b lamps (exercises), 0 of 8 points, due Tue 1 December 2026")
    assert [part.name for part in found.chapters[0].parts] == ["01_nodes", "02_topics"]
    card = found._repr_html_().split('<li class="card')[1]
    links = re.findall(r'<div class="exercises"><a href="exercises/(.*?)">(.*?)</a>', card)
    assert links == [("01_nodes/nodes.ipynb", "Exercises 1a"), ("01b_lamps/lamps.ipynb", "Exercises 1b")]
    assert card.count("due Tue 1 December 2026") == 1


def test_a_new_version_of_a_changed_notebook_is_reported(course):
    page = course_map(course)._repr_html_()
    first = '<a href="course/02_topics/lesson.ipynb">course/02_topics/lesson.ipynb</a>'
    second = '<a href="course/02_topics/lesson-new.ipynb">lesson-new.ipynb</a>'
    assert f"<li>There is a new version of {first}. Yours is unchanged; the new one is {second}.</li>" in page
    assert "New version: course/02_topics/lesson-new.ipynb" in repr(course_map(course))
    (course / "course/02_topics/lesson-new.ipynb").unlink()
    assert "new version" not in course_map(course)._repr_html_()


def test_the_picture_of_a_goal_is_an_image_in_which_nothing_can_run(course):
    (course / "course/01_nodes/goal.svg").write_text('<svg onload="alert(1)"><rect fill="#fff"/></svg>')
    page = course_map(course)._repr_html_()
    assert 'alt="" src="data:image/svg+xml,%3Csvg onload=%22alert(1)%22%3E%3Crect' in page
    assert "<svg onload" not in page


def test_each_lesson_of_the_course_is_in_a_chapter_and_has_a_picture():
    chapters = course_map(ROOT / "course").chapters
    assert [chapter.title for chapter in chapters] == [
        *("Talk", "See", "Move", "Whole robots", "Uncertain robots", "Robots in any order", "Other systems")
    ]
    parts = [part for chapter in chapters for part in chapter.parts]
    assert [part.name for part in parts[:-1]] == sorted(part.name for part in parts[:-1])
    assert [part.name for part in parts if not part.picture.startswith("<svg ")] == []
    assert max(len(part.picture) for part in parts) < 8_000


def test_all_done_is_reported(course):
    for path in course.rglob("*.ipynb"):
        path.unlink()
    write(course / "course/01_nodes/lesson.ipynb", "Lesson 1: nodes", code(run=1))
    assert "You have done all of it." in course_map(course)._repr_html_()
    assert "Next" not in repr(course_map(course))


@pytest.mark.parametrize("result", ["'8'", "nan", "-1", "True", "1e9", "99"])
def test_no_output_gives_more_than_the_checks_points(course, result):
    path = course / "exercises/01_nodes/nodes.ipynb"
    write(path, "Assignment 1: nodes", code(run=1, metadata=POINTS, result=result))
    assert course_map(course).notebooks[1].points == (8 if result == "99" else 0)


def test_outside_the_course_the_error_names_the_expected_folders(tmp_path):
    with pytest.raises(
        LookupError, match="is not in the course: expected a folder with course/ and exercises/"
    ):
        course_map(tmp_path)


def test_every_notebook_of_the_course_has_its_time_and_its_prerequisites():
    notebooks = course_map(ROOT / "course").notebooks
    assert [item.path.name for item in notebooks if not item.time] == []
    assert [item.path.parent.name for item in notebooks if not item.needs] == ["00_robot"]
    assert [item.name for item in notebooks if ("minutes" in item.time) == bool(item.most)] == []


def test_the_start_page_links_to_the_glossary_and_to_the_differences_on_a_real_robot():
    (title, *_) = json.loads((ROOT / "course/start.ipynb").read_text("utf-8"))["cells"]
    pages = re.findall(r"\]\((\w+\.md)\)", "".join(title["source"]))
    assert pages == ["glossary.md", "real_robot.md"]
    for page in pages:
        links = re.findall(r"\]\((?!https://)([^)]+)\)", (ROOT / "course" / page).read_text("utf-8"))
        assert [link for link in links if not (ROOT / "course" / link).exists()] == []


def test_assignments_have_their_due_date_in_local_time(course, monkeypatch):
    monkeypatch.setenv("TZ", "Europe/Berlin")
    time.tzset()
    try:
        (course / "course/due.json").write_text('{"01_nodes": "2026-12-01T17:00:00"}')
        due = "1 nodes (exercises), 6.5 of 16 points, due Tue 1 December 2026, 18:00 CET"
        assert repr(course_map(course)).splitlines()[1] == due
    finally:
        monkeypatch.undo()
        time.tzset()
    (course / "course/due.json").write_text("[]")
    assert "due" not in repr(course_map(course))
