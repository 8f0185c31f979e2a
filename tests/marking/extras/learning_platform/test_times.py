"""When students handed in: the platform's own times count, and no student's; from the archive to the grades."""
import csv
import io
import time
import zipfile
from dataclasses import replace
from datetime import UTC

import nbformat
import pytest
from nbgrader.api import Gradebook

from grader.marking.command.cli import main as mark
from grader.marking.extras.learning_platform.csv_file import CsvFile
from grader.marking.extras.learning_platform.grade_sheet import read_moodle
from grader.marking.extras.learning_platform.worksheet_times import submission_times
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.time_notes import time_notes
from tests.marking.classroom import ASSIGNMENT, POINTS, released, result
from tests.marking.extras.learning_platform.exports import ENGLISH, archive, canvas, moodle
from tests.marking.fake_pool import ReadyPool
from tests.marking.marked_class import mark_by_hand

NB = "nodes.ipynb"
FORGED = b"2020-01-01 00:00:00 UTC"
DUE = "2026-03-02 18:00"
ANNA, BOB, EVE = "Anna Meier_501_assignsubmission_file", "Bob_502_assignsubmission_file", "Eve_503_assignsubmission_file"
NEVER = "is never taken from a student.\n"


@pytest.fixture(autouse=True)
def berlin(monkeypatch):
    """The tests are in Berlin, where it is UTC+1 in March."""
    with monkeypatch.context() as patch:
        patch.setenv("TZ", "Europe/Berlin")
        time.tzset()
        yield
    time.tzset()


@pytest.fixture
def notebook(course) -> bytes:
    return nbformat.writes(released(course)).encode()


@pytest.fixture
def course(course) -> Course:
    """The class, in which a late day costs a tenth."""
    with open(course.root / "nbgrader_config.py", "a") as file:
        file.write("c.LateDays.percent_per_day = 10\n")
    return Course(course.root)


@pytest.fixture
def collect(course, say):
    """Collects an archive of these files: all that is printed after the first line."""

    def run(files, *options):
        status, output, wrong = say("collect", str(archive(course.root / "all.zip", files)), *options)
        assert (status, wrong) == (0, "")
        return output.partition("\n")[2]

    return run


@pytest.fixture
def marking(course, capsys):
    """Marks the class, in which everyone has all points, and what is marked by hand is done; what is printed."""

    def run() -> str:
        assert mark([ASSIGNMENT], ReadyPool(course, all_points).open) == 0
        mark_by_hand(course)
        with Gradebook(course.database, course.name) as book:
            for submission in book.assignment_submissions(ASSIGNMENT):
                next(each for each in submission.notebooks[0].grades if each.name == "essay").manual_score = 5.0
            book.db.commit()
        return capsys.readouterr().out

    return run


def all_points(course, task):
    (note,) = result(course, task).notebooks
    cells = [replace(cell, points=POINTS[cell.cell]) for cell in note.cells]
    return result(course, task, notebooks=[replace(note, cells=cells)])


def page(course, student: str) -> str:
    return (course.feedback(student, ASSIGNMENT) / "nodes.html").read_text()


def grades(path, column: int) -> list[str]:
    return [row[column] for row in csv.reader(io.StringIO(path.read_text()))][1:]


def test_a_round_trip_with_moodle_s_times(course, say, collect, marking, notebook):
    """On time, late, late within an extension; the late one forges two times."""
    sheet = course.root / "sheet.csv"
    people = [
        (501, "Anna Meier", "anna", "Monday, 2 March 2026, 6:00 PM"),
        (502, "Bob", "bob", "Wednesday, 4 March 2026, 6:00 AM"),
        (503, "Eve", "eve", "Tuesday, 3 March 2026, 12:30 PM"),
    ]
    sheet.write_text(moodle(people))
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as inner:
        inner.writestr(zipfile.ZipInfo("my/nodes.ipynb", (2020, 1, 1, 0, 0, 0)), notebook)
        inner.writestr(zipfile.ZipInfo("my/timestamp.txt", (2020, 1, 1, 0, 0, 0)), FORGED)
        inner.writestr(zipfile.ZipInfo("my/submission_secret.txt", (2020, 1, 1, 0, 0, 0)), "anna's")
    files = {f"{ANNA}_/{NB}": notebook, f"{BOB}_/my.zip": packed.getvalue(), f"{BOB}_/timestamp.txt": FORGED}
    files[f"{EVE}_/{NB}"] = notebook
    assert collect(files, "--moodle", "sheet.csv") == (
        "  Their times are those of sheet.csv, read as local time (CET).\n"
        f"  {BOB}_/my.zip: my/timestamp.txt: {NEVER}"
        f"  {BOB}_/my.zip: my/submission_secret.txt: {NEVER}"
        f"  {BOB}_/timestamp.txt: {NEVER}"
    )
    times = {who: (course.submitted(who, ASSIGNMENT) / "timestamp.txt").read_text() for who in ("anna", "bob", "eve")}
    assert times == {
        "anna": "2026-03-02 17:00:00 UTC\n",
        "bob": "2026-03-04 05:00:00 UTC\n",
        "eve": "2026-03-03 11:30:00 UTC\n",
    }
    assert not (course.submitted("bob", ASSIGNMENT) / "submission_secret.txt").exists()
    assert say("due", ASSIGNMENT, DUE)[0] == say("due", ASSIGNMENT, "2026-03-03 18:00", "--student", "eve")[0] == 0
    marking()
    table = marking()
    assert "1.5 d: -3" in table
    assert f"{ASSIGNMENT} is due on Mon 2 March 2026, 18:00 CET." in table
    assert "Needs your attention" not in table
    assert "handed in 1.5 days after Mon 2 March 2026, 18:00 CET, which costs 3 points" in page(course, "bob")
    assert "handed in" not in page(course, "anna") + page(course, "eve")
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "sheet.csv", "--feedback-zip", "back.zip")
    assert (status, wrong) == (0, "")
    assert output.endswith("back.zip: the pages of 3 students.\n")
    assert grades(sheet, ENGLISH.index("Grade")) == ["15", "12", "15"]
    with zipfile.ZipFile("back.zip") as back:
        assert back.read(f"{BOB}/feedback.html").decode() == page(course, "bob")
    assert say("due", ASSIGNMENT, "none", "--student", "eve")[0] == 0
    marking()
    assert "handed in 18.5 hours after Mon 2 March 2026, 18:00 CET, which costs 1.5 points" in page(course, "eve")


def test_a_round_trip_with_canvas_which_says_who_is_late_but_not_how_late(course, say, collect, marking, notebook):
    (course.root / "export.csv").write_text(canvas([("Meier, Anna", "1001", "", "anna"), ("Bob", "1002", "", "bob")]))
    files = {f"meieranna_1001_90_{NB}": notebook, f"bob_LATE_1002_91_{NB}": notebook}
    files["bob_LATE_1002_92_timestamp.txt"] = FORGED
    late = "  bob: handed in late, as the platform says.\n"
    dropped = f"  bob_LATE_1002_92_timestamp.txt: {NEVER}"
    assert collect(files, "--canvas", "export.csv") == dropped + late
    file = f"class/submitted/bob/{ASSIGNMENT}/timestamp.txt"
    unknown = (
        "  bob: late, as the platform says, but it doesn't say by how much, so no points are deducted here: "
        f"write the time, such as 2026-03-01 18:00:00 +0100, into {file}, or let the platform deduct points"
    )
    assert "late" not in marking()  # there is no due date
    assert say("due", ASSIGNMENT, DUE)[0] == 0
    table = marking()
    assert unknown.split() == table.partition("Needs your attention\n")[2].partition("\n\n")[0].split()
    assert "handed in" not in page(course, "bob")
    (course.root / file).write_text("2026-03-02 18:20:00 +0100")
    marking()
    table = marking()
    assert "Needs your attention" not in table
    assert "0.0 d: -1.5" in table
    assert "handed in 20 minutes after Mon 2 March 2026, 18:00 CET, which costs 1.5 points" in page(course, "bob")
    assert collect(files) == dropped + late  # the same upload: its time stays
    assert "0.0 d: -1.5" in marking()
    assert say("grades", ASSIGNMENT, "--canvas", "export.csv", "--feedback-zip", "back.zip")[:2] == (
        *(1, "export.csv: 2 grades filled in, in the column '01_class (4711)'.\nback.zip: the pages of 2 students.\n"),
    )
    assert grades(course.root / "export.csv", 5) == ["15.0", "15", "13.5"]
    with zipfile.ZipFile("back.zip") as back:
        assert back.namelist() == ["meieranna_1001_90_feedback.html", "bob_LATE_1002_91_feedback.html"]
        assert back.read("bob_LATE_1002_91_feedback.html").decode() == page(course, "bob")
    assert collect({f"bob_LATE_1002_95_{NB}": notebook + b"\n"}) == late
    assert unknown.split()[:5] == marking().partition("Needs your attention\n")[2].split()[:5]
    with Gradebook(course.database, course.name) as book:
        assert book.find_submission(ASSIGNMENT, "bob").timestamp is None


def test_submissions_without_a_time_are_listed_where_there_is_a_due_date(course, say, collect, marking, notebook):
    collect({f"{ANNA}_/{NB}": notebook, f"{ANNA}_/timestamp.txt": FORGED, f"eve_{NB}": notebook})
    assert "time of submission" not in marking()
    assert say("due", ASSIGNMENT, DUE)[0] == 0
    table = marking()
    unknown = (
        "anna, eve: the time of submission isn't known, so it doesn't count as late: collect Moodle's archive again "
        "with its worksheet, `--moodle FILE`, or write the time, such as 2026-03-01 18:00:00 +0100, into "
        f"class/submitted/STUDENT/{ASSIGNMENT}/timestamp.txt"
    )
    assert unknown.split() == table.partition("Needs your attention\n")[2].partition("\n\n")[0].split()
    many = {f"s{at}": course.root for at in range(23)}
    ((names, _),) = time_notes(course, ASSIGNMENT, many, due=True)
    assert names == ", ".join([*many][:20]) + " and 3 others"


def test_the_newest_of_several_files_counts_by_its_name_whatever_times_are_in_an_archive(course, collect, notebook):
    old = notebook.replace(b"Counter", b"Kounter")
    for newest, other in (("nodes-1", "nodes"), ("nodes (2)", "nodes(1)"), ("nodes-10", "nodes-9")):
        files = {f"{ANNA}_/{newest}.ipynb": notebook, f"{ANNA}_/{other}.ipynb": old}
        for at in (files, dict(reversed(files.items()))):
            unused = f"  {ANNA}_/{other}.ipynb: was uploaded again, {ANNA}_/{newest}.ipynb counts.\n"
            assert collect(at) == unused
            folder = course.submitted("anna", ASSIGNMENT)
            assert {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".txt"} == {NB: notebook}
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as inner:
        inner.writestr(zipfile.ZipInfo("nodes-1.ipynb", (2020, 1, 1, 0, 0, 0)), notebook)
        inner.writestr(zipfile.ZipInfo("nodes.ipynb", (2030, 1, 1, 0, 0, 0)), old)
    both = f"{ANNA}_/my.zip: nodes.ipynb: was uploaded again, {ANNA}_/my.zip: nodes-1.ipynb counts"
    assert collect({f"{ANNA}_/my.zip": packed.getvalue()}, "--assignment", ASSIGNMENT) == f"  {both}.\n"
    assert collect({f"{ANNA}_/{NB}": notebook}) == ""  # a later archive may have a plain name again


def test_an_older_archive_of_moodle_changes_nothing(course, collect, notebook):
    sheet = course.root / "sheet.csv"
    sheet.write_text(moodle([(501, "Anna Meier", "anna", "Monday, 2 March 2026, 6:00 PM")]))
    collect({f"{ANNA}_/{NB}": notebook}, "--moodle", "sheet.csv")
    sheet.write_text(moodle([(501, "Anna Meier", "anna", "Sunday, 1 March 2026, 6:00 PM")]))
    report = collect({f"{ANNA}_/{NB}": notebook + b"\n"}, "--moodle", "sheet.csv")
    assert report.endswith("  anna: this upload is older than the one that was collected before.\n")
    assert (course.submitted("anna", ASSIGNMENT) / "timestamp.txt").read_text() == "2026-03-02 17:00:00 UTC\n"
    assert (course.submitted("anna", ASSIGNMENT) / NB).read_bytes() == notebook


def test_a_damaged_list_of_uploads_stops_no_marking(course, collect, marking, notebook):
    collect({f"{ANNA}_/{NB}": notebook})
    file = course.platform_files() / f"{ASSIGNMENT}.json"
    file.write_text("[]")
    problem = f"{file} can't be read ('list' object has no attribute 'items'): delete it, and collect the archive again"
    assert f"{ASSIGNMENT}:{problem}".replace(" ", "") in "".join(marking().split())


@pytest.mark.parametrize(
    ("text", "minute"),
    [
        ("Monday, 2 March 2026, 10:05 AM", "10:05"),
        ("Monday, March 2, 2026, 12:05 AM", "00:05"),
        ("Monday, 2 March 2026, 12:05 p.m.", "12:05"),
        ("Montag, 2. März 2026, 22:05", "22:05"),
        ("lunes, 2 de marzo de 2026, 10:05", "10:05"),
        ("lundi 2 mars 2026, 10:05", "10:05"),
        ("dilluns, 2 de març 2026, 10:05", "10:05"),
        ("poniedziałek, 2 marca 2026, 10:05", "10:05"),
        ("понедельник, 2 марта 2026, 10:05", "10:05"),
        ("Thứ Hai, 2 tháng 3 2026, 10:05", "10:05"),
        ("2026年 03月 2日 (月曜日) 10:05", "10:05"),
        ("2026-03-02 10:05:59", "10:05"),
    ],
)
def test_a_worksheet_s_times_are_read_in_its_language(tmp_path, text, minute):
    assert times_of(tmp_path, text, "-") == {"501": f"2026-03-02 {minute}"}


def test_a_month_that_has_other_numbers_in_other_languages_is_read_by_its_weekday(tmp_path):
    polish, croatian = "poniedziałek, 16 listopada 2026, 10:00", "ponedjeljak, 19. listopada 2026., 10:00"
    assert times_of(tmp_path, polish) == {"501": "2026-11-16 10:00"}
    assert times_of(tmp_path, croatian) == {"501": "2026-10-19 10:00"}


@pytest.mark.parametrize("text", ["3/2/2026, 10:00", "Tuesday, 2 March 2026, 10:00 AM", "Monday, 30 February 2026, 9:00"])
def test_times_that_can_t_be_read_are_named(course, say, notebook, text):
    (course.root / "sheet.csv").write_text(moodle([(501, "Anna Meier", "anna", text)]))
    answer = say("collect", str(archive(course.root / "all.zip", {f"{ANNA}_/{NB}": notebook})), "--moodle", "sheet.csv")
    assert answer == (1, "", (
        "Nothing was collected: sheet.csv: the times in the column 'Last modified (submission)' can't be read, "
        f"such as {text!r}: export it with Moodle in English.\n"
    ))


def test_where_no_one_handed_in_the_times_of_the_grades_are_not_taken(tmp_path):
    assert times_of(tmp_path, "-") == {}
    assert times_of(tmp_path, "none") == {}


def times_of(folder, *texts: str) -> dict[str, str]:
    """The times that are read from a worksheet with these texts, in local time."""
    path = folder / "sheet.csv"
    sheet = moodle([(501 + at, "x", "y", text) for at, text in enumerate(texts)])
    path.write_text(sheet.replace(",-,-,", ',-,"Monday, 2 March 2026, 10:00 AM",'))
    found = submission_times(read_moodle(CsvFile(path)))
    return {number: f"{when.replace(tzinfo=UTC).astimezone():%Y-%m-%d %H:%M}" for number, when in found.items()}
