"""`python -m grader receipts`: which marks get one, and what is in it."""
import base64
import json
import re
import stat
from datetime import date
from typing import Any

import pytest
from nbgrader.api import Gradebook

from grader.marking.extras.receipts import cli
from grader.marking.extras.receipts.receipt import MARK, STATEMENT
from grader.marking.journal import Journal
from tests.marking.classroom import ASSIGNMENT, submit
from tests.marking.extras.receipts.conftest import ISSUER
from tests.marking.marked_class import SCRIPT, mark_by_hand, write_secret


class ADay(date):
    """What `date` is on 2 March 2026."""

    @classmethod
    def today(cls):
        return cls(2026, 3, 2)


def statement(path) -> dict[str, Any]:
    return json.loads(base64.b64decode(json.loads(path.read_text())["payload"]))


def test_every_mark_gets_a_signed_statement_with_what_it_was_given_for(course, issue, monkeypatch):
    monkeypatch.setattr("grader.marking.extras.receipts.issue.date", ADay)
    status, output, wrong = issue()
    where = course.receipts()
    reported = f"3 receipts in {where}. Keep .signing-key to yourself, and a copy of it.\n"
    assert (status, output, wrong) == (0, reported, "")
    signed = json.loads((where / "anna" / f"{ASSIGNMENT}.json").read_text())
    assert (signed["payloadType"], len(signed["signatures"])) == ("application/vnd.in-toto+json", 1)
    found = statement(where / "anna" / f"{ASSIGNMENT}.json")
    assert (found["_type"], found["predicateType"]) == (STATEMENT, MARK)
    assert [each["name"] for each in found["subject"]] == ["release", "requirements.lock", "submission"]
    assert all(re.fullmatch("[0-9a-f]{64}", each["digest"]["sha256"]) for each in found["subject"])
    about = found["predicate"]
    assert {name: about[name] for name in ("student", "name", "points", "most", "issuer", "issued")} == {
        **{"student": "anna", "name": "Anna Meier", "points": 15.0, "most": 15.0},
        **{"issuer": ISSUER, "issued": "2026-03-02"},
    }
    assert about["cells"][0] == {
        **{"cell": "nodes/test_counter", "exercise": "counter", "points": 4.0, "most": 4.0, "recordings": []},
    }
    assert {"course", "Python", "numpy"} <= set(about["versions"]) and "secret" not in about["versions"]


def test_seeds_are_sealed_until_they_are_revealed(receipt, issue):
    sealed = statement(receipt)["predicate"]
    assert (len(sealed["seal"]), sealed["nonce"], sealed["seeds"]) == (64, "", {})
    assert issue("--reveal")[0] == 0
    opened = statement(receipt)["predicate"]
    assert opened["seal"] == sealed["seal"] and len(opened["nonce"]) == 64
    assert set(opened["seeds"]) == {"counter", "line"}
    assert {**opened, "nonce": "", "seeds": {}} == sealed


def test_the_key_is_its_owner_s_alone_and_no_file_holds_a_secret(course, receipt):
    key = course.root / ".signing-key"
    assert stat.S_IMODE(key.stat().st_mode) == 0o600
    for path in course.receipts().rglob("*.*"):
        assert "of this class" not in path.read_text() and "PRIVATE" not in path.read_text()


def test_what_is_unchanged_is_the_same_receipt_on_another_day(course, receipt, issue, monkeypatch):
    page = course.receipts() / "anna.html"
    before = receipt.read_bytes(), page.read_bytes()
    monkeypatch.setattr("grader.marking.extras.receipts.issue.date", ADay)
    assert issue("--student", "anna")[0] == 0
    assert (receipt.read_bytes(), page.read_bytes()) == before
    mark_by_hand(course, 4.0)
    assert issue()[0] == 0
    assert statement(receipt)["predicate"]["points"] == 14.0
    assert statement(receipt)["predicate"]["issued"] == "2026-03-02"


def test_a_certificate_has_what_was_passed_and_is_harmless(course, receipt, issue):
    pages = {path.name for path in course.receipts().glob("*.html")}
    assert pages == {"anna.html", "eve.html"}  # bob has no points
    text = (course.receipts() / "eve.html").read_text()
    assert SCRIPT not in text and "&lt;script&gt;alert(1)" in text and "15 of 15" in text
    mark_by_hand(course, 0.0)
    assert issue("--pass", "80")[0] == 0
    assert list(course.receipts().glob("*.html")) == []


def look_again(course):
    with Gradebook(course.database, course.name) as book:
        book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades[0].needs_manual_grade = True
        book.db.commit()


def other_points(course):
    with Gradebook(course.database, course.name) as book:
        grades = {each.name: each for each in book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades}
        grades["test_line"].auto_score = 1.0
        book.db.commit()


def no_entry(course):
    (course.journal(ASSIGNMENT) / "anna.json").unlink()


def no_evidence(course):
    journal = Journal(course.journal(ASSIGNMENT))
    journal.save(journal.last("anna").result)


def new_secret(course):
    write_secret(course.root, "of another class")


AGAIN = f"mark {ASSIGNMENT} again"


@pytest.mark.parametrize(
    ("change", "doubt"),
    [
        (look_again, "still needs a look in the formgrader"),
        (other_points, f"has different points in the gradebook from those that marking gave: {AGAIN}"),
        (no_entry, f"was not marked by `python -m grader mark {ASSIGNMENT}`"),
        (no_evidence, f"was marked before there were receipts: {AGAIN}, with --force"),
        (new_secret, f"was marked with a different secret from the one in .secret: {AGAIN}"),
    ],
)
def test_a_doubtful_mark_has_no_receipt(course, issue, change, doubt):
    change(course)
    status, _, wrong = issue("--student", "anna")
    assert (status, wrong) == (1, f"anna: {ASSIGNMENT} {doubt}. It has no receipt.\n")
    assert not (course.receipts() / "anna").exists()


def test_without_marks_or_library_or_key_there_are_no_receipts(course, issue, monkeypatch):
    none = "the gradebook has no marks: run `python -m grader mark ASSIGNMENT` first"
    assert issue("--student", "x") == (1, "", f"No receipts: {none}.\n")
    key = course.root / ".signing-key"
    key.write_text("no")
    key.chmod(0o644)
    assert issue() == (1, "", f"No receipts: others may read {key}: run `chmod 600 .signing-key`.\n")
    key.chmod(0o600)
    _, _, wrong = issue()
    assert wrong.startswith(f"No receipts: {key} is not a private key (") and wrong.endswith("): take it from a backup.\n")
    monkeypatch.setattr(cli, "find_spec", lambda name: None)
    assert issue() == (1, "", f"No receipts: {cli.LIBRARY}.\n")


def test_a_folder_that_can_t_be_written_is_named(course, issue):
    course.receipts().write_text("a file")
    status, _, wrong = issue()
    assert (status, wrong) == (1, f"Stopped: {course.receipts()} could not be written (File exists).\n")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--issuer", "x", "--pass", "0"), "argument --pass: expected a number above 0, at most 100, saw '0'"),
        (("--issuer", "x", "--pass", "a"), "argument --pass: expected a number above 0, at most 100, saw 'a'"),
    ],
)
def test_options_that_are_none(course, say, capsys, options, sentence):
    with pytest.raises(SystemExit, match="2"):
        say("receipts", *options)
    assert capsys.readouterr().err.endswith(f"error: {sentence}\n")


def test_a_new_submission_leaves_the_receipt_of_the_old_one(course, receipt, issue):
    before = receipt.read_bytes()
    submit(course, "anna", line="Line = 3")
    assert issue("--student", "anna")[0] == 0
    assert receipt.read_bytes() == before
