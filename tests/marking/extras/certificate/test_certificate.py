"""`python -m grader certificate`: pages and receipt."""
import hashlib
import json
import shutil
import stat
from datetime import date

import pytest
from nbgrader.api import Gradebook

from grader.marking.command.cli import main as mark
from grader.marking.extras.certificate import cli
from grader.marking.extras.certificate.certificate_page import read_page
from grader.marking.journal import Journal
from grader.marking.version import versions
from tests.marking.classroom import ASSIGNMENT
from tests.marking.extras.certificate.conftest import ISSUER, marked, number, write_secret
from tests.marking.fake_pool import ReadyPool

SHARE = "argument --pass: expected a number above 0, at most 100"


class ADay(date):
    """What `date` is on 2 March 2026."""

    @classmethod
    def today(cls):
        return cls(2026, 3, 2)


def test_a_page_says_what_was_passed_and_bears_the_digest_of_the_result(course, say, monkeypatch):
    monkeypatch.setattr(cli, "date", ADay)
    status, output, wrong = say("certificate", "--issuer", ISSUER, "--pass", "62.5")
    kept = course.certificates() / "receipt.json"
    assert (status, wrong) == (0, "")
    assert output.splitlines() == [
        "anna: 1 of 1 passed",
        "bob: none passed, no page",
        "eve: 1 of 1 passed",
        f"2 certificates in {kept.parent}. "
        "Keep receipt.json there, and .secret, as long as you want to confirm them.",
    ]
    result = Journal(course.journal(ASSIGNMENT)).last("anna").result
    page = kept.parent / "anna.html"
    assert read_page(page.read_text()) == {
        "certificate number": number(page),
        "name": "Anna Meier",
        "student id": "anna",
        "issuer": ISSUER,
        "date": "2 March 2026",
        "course version": versions()["course"],
        "share that passes": "62.5 %",
        "number of assignments": "1 of 1",
        f"title of {ASSIGNMENT}": ASSIGNMENT,
        f"score of {ASSIGNMENT}": "15 of 15",
        f"digest of {ASSIGNMENT}": hashlib.sha256(result.grade_json().encode()).hexdigest(),
    }
    assert not (kept.parent / "bob.html").exists()


def test_the_receipt_is_its_owners_alone_and_holds_no_secret(page):
    kept = page.with_name("receipt.json")
    assert stat.S_IMODE(kept.stat().st_mode) == 0o600
    secret = "of this class"
    for held in (secret, hashlib.sha256(secret.encode()).hexdigest()):
        assert held not in kept.read_text() + page.read_text()


def test_a_page_stays_where_nothing_changed_and_an_earlier_one_is_still_good(course, page, say, monkeypatch):
    before = page.read_bytes()
    monkeypatch.setattr(cli, "date", ADay)
    assert say("certificate", "--issuer", ISSUER)[0] == 0
    assert page.read_bytes() == before
    assert say("certificate", "--issuer", "Somebody else", "--student", "anna")[0] == 0
    assert page.read_bytes() != before
    (course.root / "old.html").write_bytes(before)
    for each in ("old.html", str(page)):
        assert say("confirm", each)[0] == 0
    assert len(json.loads(page.with_name("receipt.json").read_text())) == 3


def test_a_strangers_name_stays_text(page):
    text = page.with_name("eve.html").read_text()
    assert "<script" not in text
    assert "&lt;script&gt;alert(1)&lt;/script&gt;  evE [2J" in text


def test_a_name_with_a_path_in_it_gets_no_page(course, page, say):
    with Gradebook(course.database) as book:
        book.update_or_create_student("../../out")
        with book.db.no_autoflush:
            book.update_or_create_submission(ASSIGNMENT, "../../out")
    status, output, wrong = say("certificate", "--issuer", ISSUER)
    assert (status, "../../out: none passed, no page" in output) == (1, True)
    why = f"was not marked by `python -m grader mark {ASSIGNMENT}`"
    assert wrong == f"../../out: {ASSIGNMENT} {why}. It is left out.\n"
    assert list(course.root.glob("*.html")) == []


def test_what_still_needs_a_look_is_left_out(course, say):
    with Gradebook(course.database, course.name) as book:
        grade = book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades[0]
        grade.needs_manual_grade = True
        book.db.commit()
    status, output, wrong = say("certificate", "--issuer", ISSUER, "--student", "anna")
    assert (status, output.splitlines()[0]) == (1, "anna: none passed, no page")
    assert wrong == f"anna: {ASSIGNMENT} still needs a look in the formgrader. It is left out.\n"


def test_points_that_marking_did_not_give_are_left_out(course, say):
    with Gradebook(course.database, course.name) as book:
        grades = book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades
        next(grade for grade in grades if grade.name == "test_line").auto_score = 5.0
        book.db.commit()
    _, _, wrong = say("certificate", "--issuer", ISSUER, "--student", "anna")
    why = f"has other points in the gradebook than marking gave: mark {ASSIGNMENT} again"
    assert wrong == f"anna: {ASSIGNMENT} {why}. It is left out.\n"


def test_what_being_late_costs_is_not_certified(course, say):
    with Gradebook(course.database, course.name) as book:
        book.find_submission(ASSIGNMENT, "anna").notebooks[0].late_submission_penalty = 1.5
        book.db.commit()
    assert say("certificate", "--issuer", ISSUER)[0] == 0
    page = (course.certificates() / "anna.html").read_text()
    assert read_page(page)[f"score of {ASSIGNMENT}"] == "13.5 of 15"


def test_who_has_passed_nothing_any_more_has_no_page(course, page, say):
    pool = ReadyPool(course, lambda course, task: marked(course, task, line=0.0))
    assert mark([ASSIGNMENT, "--no-feedback", "--force", "--student", "anna"], pool.open) == 0
    options = ("certificate", "--issuer", ISSUER, "--student", "anna", "--pass", "90")
    assert say(*options)[0] == 1  # first somebody has to look
    with Gradebook(course.database, course.name) as book:
        for grade in book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades:
            grade.needs_manual_grade = False
        book.db.commit()
    assert say(*options)[0] == 0
    assert not page.exists()


def test_without_a_secret_there_are_none(course, say):
    (course.root / ".secret").unlink()
    why = f"certificates need your secret, and there is no .secret in {course.root}"
    assert say("certificate", "--issuer", ISSUER) == (1, "", f"No certificates: {why}.\n")


def test_an_unknown_student_is_named(course, say):
    why = "the gradebook has no mark of “zoe”"
    assert say("certificate", "--issuer", ISSUER, "--student", "zoe") == (1, "", f"No certificates: {why}.\n")


def test_for_a_class_without_marks_it_is_reported_how_to_get_them(template, tmp_path, monkeypatch, say):
    folder = tmp_path / "fresh"
    shutil.copytree(template, folder)
    write_secret(folder, "x")
    monkeypatch.chdir(folder)
    why = "the gradebook has no marks: run `python -m grader mark ASSIGNMENT` first"
    assert say("certificate", "--issuer", ISSUER) == (1, "", f"No certificates: {why}.\n")


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("{", "Expecting property name enclosed in double quotes: line 1 column 2 (char 1)"),
        ('{"1": 2}', "expected a table of tables"),
        ("[]", "'list' object has no attribute 'values'"),
    ],
)
def test_a_damaged_receipt_is_not_written_over(course, page, say, content, reason):
    kept = page.with_name("receipt.json")
    kept.write_text(content)
    why = f"No certificates: {kept} can't be read ({reason}): take it from a backup.\n"
    assert say("certificate", "--issuer", ISSUER) == (1, "", why)
    assert kept.read_text() == content


def test_a_place_that_can_not_be_written_is_named(course, say):
    course.certificates().write_text("in the way")
    status, _, wrong = say("certificate", "--issuer", ISSUER)
    assert (status, wrong) == (1, f"Stopped: {course.certificates()} could not be written (File exists).\n")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ((), "the following arguments are required: --issuer"),
        (("--issuer", " "), "argument --issuer: expected your name and address, saw nothing"),
        (("--issuer", "x", "--pass", "0"), f"{SHARE}, saw '0'"),
        (("--issuer", "x", "--pass", "nan"), f"{SHARE}, saw 'nan'"),
        (("--issuer", "x", "--pass", "half"), f"{SHARE}, saw 'half'"),
    ],
)
def test_wrong_options_are_refused(say, capsys, options, words):
    with pytest.raises(SystemExit, match="2"):
        say("certificate", *options)
    assert capsys.readouterr().err.endswith(f"error: {words}\n")
