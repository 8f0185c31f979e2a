import sqlite3
from dataclasses import replace

import pytest
from nbgrader.api import Gradebook

from grader.marking.command import task_reader
from grader.marking.command.mark_class import Settings, mark_class
from grader.marking.errors import CourseError
from grader.marking.submission.submitted_files import read_folder
from tests.marking.classroom import ASSIGNMENT, gradebook, result, submit
from tests.marking.fake_pool import ReadyPool

ALL = ["anna", "bob", "eve"]
MARKED = Settings(feedback=False)


@pytest.fixture
def pool(course):
    return ReadyPool(course)


def run(course, pool, settings=MARKED):
    return mark_class(course, ASSIGNMENT, settings, pool.open)


def notebook(course, student):
    return course.autograded(student, ASSIGNMENT) / "nodes.ipynb"


def test_a_class_is_marked_and_everything_is_where_nbgrader_looks_for_it(course, pool):
    outcome = run(course, pool, Settings())
    assert (outcome.fresh, sorted(outcome.results), outcome.total, outcome.problems) == (ALL, ALL, 3, [])
    assert {who: row["score"] for who, row in gradebook(course).items()} == {
        who: found.points for who, found in outcome.results.items()
    }
    for student in ALL:
        assert notebook(course, student).exists()
        assert (course.feedback(student, ASSIGNMENT) / "nodes.html").exists()


def test_what_has_not_changed_is_not_marked_again_and_the_summary_is_of_all(course, pool):
    first = run(course, pool)
    before = gradebook(course)
    times = [notebook(course, student).stat().st_mtime_ns for student in ALL]
    pool.again()
    second = run(course, pool)
    assert (pool.again(), second.fresh) == ([], [])
    assert second.results == first.results
    assert gradebook(course) == before
    assert [notebook(course, student).stat().st_mtime_ns for student in ALL] == times


def test_each_submission_is_read_once_and_what_was_read_is_marked(course, pool, monkeypatch):
    read = []

    def counted(folder, release):
        read.append(folder.parent.name)
        return read_folder(folder, release)

    monkeypatch.setattr(task_reader, "read_folder", counted)
    assert run(course, pool).fresh == read == ALL
    submit(course, "bob", line="Line = 3")
    read.clear()
    assert run(course, pool).fresh == ["bob"]
    assert read == ALL


def test_what_has_changed_or_come_since_is_marked(course, pool):
    run(course, pool)
    submit(course, "bob", line="Line = 3")
    submit(course, "zoe")
    pool.again()
    assert run(course, pool).fresh == ["bob", "zoe"]
    assert sorted(gradebook(course)) == [*ALL, "zoe"]


def test_only_the_chosen_students_are_marked(course, pool):
    assert run(course, pool, replace(MARKED, students=["eve"])).fresh == ["eve"]
    assert list(gradebook(course)) == ["eve"]


def test_force_marks_again_and_asks_for_another_look_at_what_was_set_by_hand(course, pool):
    run(course, pool)
    with Gradebook(course.database, course.name) as book:
        grade = book.find_grade("test_line", "nodes", ASSIGNMENT, "anna")
        grade.manual_score, grade.needs_manual_grade = 5, False
        book.db.commit()
    run(course, pool)
    assert not gradebook(course)["anna"]["test_line"]["needs_manual_grade"]
    pool.again()
    assert run(course, pool, replace(MARKED, force=True, students=["anna"])).fresh == ["anna"]
    row = gradebook(course)["anna"]["test_line"]
    assert (row["manual_score"], row["needs_manual_grade"]) == (5, True)


def test_a_changed_time_alone_is_entered_without_marking_again(course, pool):
    run(course, pool)
    pool.again()
    (course.submitted("bob", ASSIGNMENT) / "timestamp.txt").write_text("2026-02-02 10:00:00 UTC")
    run(course, pool)
    assert pool.again() == []
    assert gradebook(course)["bob"]["time"] == "2026-02-02 10:00:00"


def test_a_gradebook_or_notebooks_that_are_gone_are_made_again_from_the_journal(course, pool, template):
    run(course, pool)
    before = gradebook(course)
    pool.again()
    (course.root / "class" / "gradebook.db").write_bytes((template / "class" / "gradebook.db").read_bytes())
    notebook(course, "anna").unlink()
    run(course, pool)
    assert gradebook(course) == before
    assert notebook(course, "anna").exists()
    assert pool.again() == []


def test_a_torn_result_is_marked_anew(course, pool):
    run(course, pool)
    (course.journal(ASSIGNMENT) / "bob.json").write_text('{"torn')
    assert run(course, pool).fresh == ["bob"]


def test_while_another_program_holds_the_gradebook_marking_goes_on(course, pool):
    course.directory.db_url += "?timeout=0.05"  # seconds of patience
    holder = sqlite3.connect(course.root / "class" / "gradebook.db", check_same_thread=False)

    def hold(here, task):
        if task.student == "bob":
            holder.execute("BEGIN EXCLUSIVE")
        return result(here, task)

    pool.change = hold
    outcome = run(course, pool)
    assert outcome.fresh == ALL
    (problem,) = outcome.problems
    assert problem.endswith(
        "then mark again. 2 marked submissions are not in it yet, and nothing is lost."
    )
    holder.rollback()
    assert list(gradebook(course)) == ["anna"]
    pool.again()
    assert run(course, pool).problems == []
    assert sorted(gradebook(course)) == ALL
    assert pool.again() == []


def test_a_gradebook_that_is_free_again_in_the_end_gets_everything(course, pool):
    course.directory.db_url += "?timeout=0.05"  # seconds of patience
    holder = sqlite3.connect(course.root / "class" / "gradebook.db", check_same_thread=False)

    def hold(here, task):
        holder.execute("BEGIN EXCLUSIVE") if task.student == "bob" else holder.rollback()
        return result(here, task)

    pool.change = hold
    assert run(course, pool).problems == []
    assert sorted(gradebook(course)) == ALL


def test_ctrl_c_keeps_what_is_marked(course, pool):
    def interrupt(here, task):
        if task.student == "bob":
            raise KeyboardInterrupt
        return result(here, task)

    pool.change = interrupt
    outcome = run(course, pool, Settings())
    assert outcome.interrupted
    assert (outcome.fresh, list(gradebook(course))) == (["anna"], ["anna"])
    pool.change = result
    assert run(course, pool, Settings()).fresh == ["bob", "eve"]
    assert (course.feedback("anna", ASSIGNMENT) / "nodes.html").exists()


def test_after_ctrl_c_the_outcome_still_has_all_results(course, pool):
    run(course, pool)
    submit(course, "anna", line="Line = 3")

    def interrupt(here, task):
        raise KeyboardInterrupt

    pool.change = interrupt
    outcome = run(course, pool)
    assert outcome.interrupted
    assert (outcome.fresh, list(outcome.results)) == ([], ["bob", "eve"])


def test_what_is_handed_in_anew_while_others_are_marked_is_stored_as_what_was_marked(course, pool):
    def change(here, task):
        if task.student == "anna":
            submit(course, "eve", line="Line = 3")
        return result(here, task)

    pool.change = change
    assert run(course, pool).fresh == ALL
    pool.again()
    assert run(course, pool).fresh == []


def test_a_submission_without_a_result_is_named(course, pool):
    pool.mark = lambda tasks: iter([result(course, next(tasks))])
    assert run(course, pool).problems == ["bob was not marked: mark again", "eve was not marked: mark again"]


@pytest.mark.parametrize("changes", [{"student": "mallory"}, {"key": "00"}, {"assignment": "02"}])
def test_a_result_that_was_not_requested_is_refused(course, pool, changes):
    pool.change = lambda here, task: replace(result(here, task), **changes)
    with pytest.raises(RuntimeError, match="that was not requested"):
        run(course, pool)
    assert gradebook(course) == {}


def test_the_pool_gets_settings_and_secret(course, pool):
    (course.root / ".secret").touch(mode=0o600)
    (course.root / ".secret").write_text("d1ce\n")
    run(course, pool, replace(MARKED, jobs=3, unsafe=True))
    assert pool.secret == "d1ce"
    assert [(settings.jobs, settings.unsafe) for settings in pool.settings] == [(3, True)]
    (course.root / ".secret").write_text("another")
    pool.again()
    assert run(course, pool).fresh == ALL


def test_a_page_that_fails_is_named_and_the_others_are_made(course, pool):
    def broken(here, task):
        found = result(here, task)
        if task.student == "bob":
            found.notebooks[0].notebook["cells"][2]["metadata"]["nbgrader"]["grade_id"] = "unknown"
        return found

    pool.change = broken
    outcome = run(course, pool, Settings())
    (problem,) = outcome.problems
    why = f"`nbgrader generate_feedback {ASSIGNMENT} --force --student bob` shows why"
    assert problem == f"the page of bob could not be made: {why}"
    assert (course.feedback("eve", ASSIGNMENT) / "nodes.html").exists()
    pool.change = result
    assert run(course, pool, replace(Settings(), students=["bob"], force=True)).problems == []


def unjudged(course, task, **changes):
    """A result whose test cells ended before their nodes were run."""
    found = result(course, task, **changes)
    cells = [replace(cell, points=0.0, verdicts=[]) for cell in found.notebooks[0].cells]
    return replace(found, notebooks=[replace(found.notebooks[0], cells=cells)])


def entered(course):
    """What a run leaves: students in gradebook, journal, autograded/ and feedback/."""
    folders = [course.journal(ASSIGNMENT), course.autograded("x", ASSIGNMENT).parents[1]]
    folders += [course.feedback("x", ASSIGNMENT).parents[1]]
    return sorted({*gradebook(course), *(path.stem for folder in folders for path in folder.glob("[!.]*"))})


def nothing_judged(course, pool, settings=MARKED):
    with pytest.raises(CourseError) as caught:
        run(course, pool, settings)
    assert entered(course) == []
    return str(caught.value)


NO_MODULE = "ModuleNotFoundError: No module named 'launch_process_starters'"


def test_a_class_in_which_nothing_could_be_judged_is_an_error_and_changes_nothing(course, pool):
    flag = f"The test cell `test_counter`: not graded, and worth a look. {NO_MODULE}."
    pool.change = lambda course, task: unjudged(course, task, flags=[flag])
    assert nothing_judged(course, pool, Settings()) == (
        "none of the 3 submissions could be judged, so nothing was entered and no page made "
        f"(anna: {flag[:-1]}); if it is the student's own fault, add `--student anna`"
    )


def test_an_error_in_the_cells_is_the_reason_if_there_is_no_other(course, pool):
    def failing(course, task):
        found = unjudged(course, task)
        error = {"output_type": "error", "ename": "ImportError", "evalue": "no grader", "traceback": []}
        found.notebooks[0].notebook["cells"][1]["outputs"] = [error]
        return found

    pool.change = failing
    assert "(anna: ImportError: no grader)" in nothing_judged(course, pool)


def test_a_submission_that_the_course_could_not_judge_is_never_entered(course, pool):
    def broken_for_bob(course, task):
        changes = {"verdict": "broken", "reason": "a bug in the course: KeyError: 'x'"}
        return unjudged(course, task, **changes) if task.student == "bob" else result(course, task)

    pool.change = broken_for_bob
    outcome = run(course, pool, Settings())
    assert outcome.problems == ["bob was not marked: a bug in the course: KeyError: 'x'"]
    assert (outcome.fresh, entered(course)) == (["anna", "eve"], ["anna", "eve"])
    pool.again()
    pool.change = result
    assert run(course, pool, Settings()).problems == []
    assert (pool.again(), entered(course)) == (["bob"], ALL)


def test_if_the_course_failed_for_all_even_those_who_were_named_are_not_marked(course, pool):
    pool.change = lambda course, task: unjudged(course, task, verdict="broken", reason="It broke.")
    assert nothing_judged(course, pool, replace(MARKED, students=["eve"])) == (
        "the submission could not be judged, so nothing was entered and no page made (eve: It broke)"
    )


def test_students_own_faults_are_marked_once_another_was_judged_or_they_are_named(course, pool):
    pool.change = lambda course, task: (result if task.student == "eve" else unjudged)(course, task)
    assert run(course, pool).fresh == ["eve", "anna", "bob"]
    submit(course, "bob", line="Line = 3")
    pool.change = unjudged
    assert run(course, pool).fresh == ["bob"]  # eve's stored result was judged
    assert run(course, pool, replace(MARKED, force=True, students=["anna"])).fresh == ["anna"]
    assert gradebook(course)["anna"]["score"] == 0
