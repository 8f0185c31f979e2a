"""`python -m grader mark --dry-run`: whose marks would change and why, with nothing written."""
import hashlib

import pytest

from grader.marking.command import cli, dry_run
from grader.marking.command.task_reader import TaskReader
from grader.marking.gradebook.book import Book
from grader.marking.journal import Journal
from grader.marking.version import course_version
from tests.marking.classroom import ASSIGNMENT, result, submit
from tests.marking.fake_pool import ReadyPool
from tests.marking.marked_class import course, marked, marked_template, say, write_secret  # noqa: F401

VERSION = course_version()


@pytest.fixture
def rehearse(course, capsys):  # noqa: F811
    """Runs it, in which judging gives 6 points for the line or those given; all lines, and who was judged."""

    def run(*options: str, line: float = 6.0) -> tuple[list[str], list[str]]:
        pool = ReadyPool(course, lambda course, task: marked(course, task, line))
        before = files(course)
        assert cli.main([ASSIGNMENT, "--dry-run", *options], pool.open) == 0
        assert files(course) == before
        return capsys.readouterr().out.splitlines(), pool.marked

    return run


def files(course) -> dict[str, tuple[int, str]]:  # noqa: F811
    """Everything in the class: when it was changed, and its content."""
    found = sorted(path for path in (course.root / "class").rglob("*") if path.is_file())
    digests = [hashlib.sha256(path.read_bytes()).hexdigest() for path in found]
    return {str(path): (path.stat().st_mtime_ns, digest) for path, digest in zip(found, digests, strict=True)}


def last(changes: int, judged: int, total: int = 3) -> str:
    marks = f"{changes} of {total} marks of {ASSIGNMENT} would change"
    return f"{marks}, after judging {judged} again. Nothing was written."


def test_where_nothing_has_changed_nothing_is_judged(rehearse):
    assert rehearse() == ([f"Version of the course: {VERSION}", last(0, 0)], [])


def test_a_new_submission_and_one_that_is_submitted_later(rehearse, course):  # noqa: F811
    submit(course, "anna", line="Line = 3")
    submit(course, "zoe")
    assert rehearse(line=1.5) == (
        [
            "Marks that would change",
            "  anna: 15 -> 10.5: the submission has changed; nodes/test_line 6 -> 1.5",
            "  zoe: none -> 5.5: it was not marked yet",
            f"Version of the course: {VERSION}",
            last(2, 2, 4),
        ],
        ["anna", "zoe"],
    )
    assert rehearse("--student", "zoe")[1] == ["zoe"]


def test_a_change_of_the_course_is_named_and_only_its_marks_are_listed(rehearse, course, monkeypatch):  # noqa: F811
    monkeypatch.setattr(dry_run, "course_version", lambda: "0123456789ab")
    evidence = dry_run.evidence
    monkeypatch.setattr(dry_run, "evidence", lambda *about: evidence(*about) | {"course": "new"})
    monkeypatch.setattr(TaskReader, "__init__", newer(TaskReader.__init__))
    lines, judged = rehearse(line=4.0)
    assert judged == ["anna", "bob", "eve"]
    assert lines == [
        "Marks that would change",
        "  anna: 15 -> 13: the course's code has changed; nodes/test_line 6 -> 4",
        "  eve: 15 -> 13: the course's code has changed; nodes/test_line 6 -> 4",
        f"Version of the course: {VERSION} -> 0123456789ab",
        last(2, 3),
    ]


def newer(start):
    """The start of a reader for another version of the course."""

    def run(self, *arguments):
        start(self, *arguments)
        self._version = "0" * 64

    return run


def test_another_secret_and_a_changed_assignment_and_force(rehearse, course):  # noqa: F811
    forced = rehearse("--force", line=4.0)
    assert forced[0][1] == "  anna: 15 -> 13: it is judged again, as --force requests; nodes/test_line 6 -> 4"
    write_secret(course.root, "another")
    assert rehearse(line=4.0)[0][1] == "  anna: 15 -> 13: there is another secret; nodes/test_line 6 -> 4"
    (course.release(ASSIGNMENT) / "map.txt").write_text("new")
    both = "the assignment has changed and there is another secret"
    assert rehearse(line=4.0)[0][1] == f"  anna: 15 -> 13: {both}; nodes/test_line 6 -> 4"
    for student in ("anna", "bob", "eve"):
        entry = Journal(course.journal(ASSIGNMENT)).last(student)
        Journal(course.journal(ASSIGNMENT)).save(entry.result, {})
    lines, _ = rehearse(line=4.0)
    assert lines[-2] == f"Version of the course: an older one -> {VERSION}"


def test_a_due_date_that_was_set_later(rehearse, course, say):  # noqa: F811
    with open(course.root / "nbgrader_config.py", "a") as file:
        file.write("c.LateDays.percent_per_day = 10\n")
    say("due", ASSIGNMENT, "2025-12-31 12:00+00:00")  # they handed in on 1 January at 10:00
    course.__init__(course.root)
    with Book(course) as book:
        before = book.marks()
    lines, judged = rehearse()
    assert (judged, lines[1]) == ([], "  anna: 15 -> 13.5: penalty for being late 0 -> 1.5")
    with Book(course) as book:
        assert book.marks() == before


def test_a_submission_that_could_not_be_judged_is_named(course, capsys):  # noqa: F811
    submit(course, "zoe")
    broken = {"verdict": "broken", "reason": "No memory.", "notebooks": []}
    pool = ReadyPool(course, lambda *about: result(*about, **broken))
    assert cli.main([ASSIGNMENT, "--dry-run"], pool.open) == 0
    named = "  zoe: could not be judged. No memory."
    found = capsys.readouterr().out.splitlines()
    assert found == [named, f"Version of the course: {VERSION}", last(0, 1, 4)]


def test_it_writes_no_files(course, capsys):  # noqa: F811
    for option in ("--csv", "--html"):
        with pytest.raises(SystemExit, match="2"):
            cli.main([ASSIGNMENT, "--dry-run", option, "x"])
        problem = "error: --dry-run writes nothing: leave out --csv and --html\n"
        assert capsys.readouterr().err.endswith(problem)
