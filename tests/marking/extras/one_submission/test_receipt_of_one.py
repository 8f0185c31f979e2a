"""A receipt from `mark-one`: anyone confirms it with the public key, and nothing that was changed."""
import base64
import json
import shutil
from pathlib import Path

import pytest

from grader.__main__ import main
from grader.marking.extras.one_submission import receipt_of_one
from grader.marking.extras.receipts.receipt import MARK, STATEMENT
from tests.marking.hostile.corpus import ASSIGNMENT, NAME, SECRET, course, submit

ISSUER = "Chair of Robotics, robotics@example.org"
DUE, HANDED_IN = "2026-03-01 12:00+00:00", "2026-03-02 18:00+00:00"
LATE = ("--due", DUE, "--handed-in", HANDED_IN, "--percent-per-day", "10")
CHANGED = "the signature does not match: the receipt was changed after it was issued"
BY_HAND = {"nbgrader": {"grade": True, "grade_id": "essay", "locked": False, "points": 5, "schema_version": 3,
                        "solution": True, "task": False}}  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A course with a secret and two submissions."""
    place = course(tmp_path_factory.mktemp("course"))
    submit(place, ["honest_half", "honest_starter"])
    return place


def words(folder: Path, *more: str) -> list[str]:
    submission = folder / "class" / "submitted" / "honest_half" / ASSIGNMENT
    given = ["--assignment", ASSIGNMENT, "--student", "ann", "--no-self-check", "--issuer", ISSUER]
    return ["mark-one", str(submission), *given, "--receipt", "signed/receipt.json", "--out", "r.json", *more]


@pytest.fixture(scope="module")
def issued(folder) -> Path:
    """The folder with the receipt of a submission that was handed in late, and the public key."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert main(words(folder, *LATE)) == 0
    return folder / "signed"


@pytest.fixture
def elsewhere(issued, tmp_path, monkeypatch) -> Path:
    """The folder of a third party: the receipt and the public key, and nothing of the course."""
    for path in issued.iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def confirm(capsys, *more: object) -> tuple[int, str, str]:
    status = main(["verify", "receipt.json", "--key", "public.pem", *map(str, more)])
    return status, *capsys.readouterr()


def test_a_third_party_confirms_it_with_the_public_key_alone(folder, elsewhere, capsys):
    assert sorted(path.name for path in elsewhere.iterdir()) == ["public.pem", "receipt.json"]
    status, output, wrong = confirm(capsys)
    assert (status, wrong) == (0, "")
    assert output.startswith(f"Confirmed: ann (ann) has 12 of 33 points in {ASSIGNMENT}, says {ISSUER} on ")
    assert json.loads((folder / "r.json").read_text())["points_after_lateness"] == 12.0
    key = folder / ".signing-key"
    assert key.stat().st_mode & 0o077 == 0


def test_it_is_an_in_toto_statement_that_reveals_no_secret(elsewhere):
    text = (elsewhere / "receipt.json").read_text()
    statement = json.loads(base64.b64decode(json.loads(text)["payload"]))
    assert (statement["_type"], statement["predicateType"]) == (STATEMENT, MARK)
    assert statement["predicate"]["seal"]
    assert (statement["predicate"]["seeds"], statement["predicate"]["nonce"]) == ({}, "")
    assert SECRET not in json.dumps(statement)


def test_the_instructor_marks_again_with_equal_recordings(folder, issued, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    submission = folder / "class" / "submitted" / "honest_half" / ASSIGNMENT
    given = ["--submission", submission, "--release", folder / "exercises" / ASSIGNMENT]
    status = main(["verify", "signed/receipt.json", "--key", "signed/public.pem", *map(str, given)])
    output, wrong = capsys.readouterr()
    assert (status, wrong) == (0, "")
    assert output.splitlines()[1:] == [
        "Submission and release are those that were marked.",
        "Marked again, with equal points and recordings: 15 in 2 test cells.",
    ]


def test_another_students_submission_is_not_the_one_that_was_marked(folder, elsewhere, capsys):
    other = folder / "class" / "submitted" / "honest_starter" / ASSIGNMENT
    status, _, wrong = confirm(capsys, "--submission", other, "--release", folder / "exercises" / ASSIGNMENT)
    assert status == 1
    reported = f"{other} is not the submission that was marked: its digest differs"
    assert wrong == f"Not confirmed: {reported}.\n"


@pytest.mark.parametrize(
    ("old", "new"), [('"points": 12.0', '"points": 30.0'), ('"student": "ann"', '"student": "eve"')]
)
def test_a_changed_one_is_refused(elsewhere, capsys, old, new):
    path = elsewhere / "receipt.json"
    signed = json.loads(path.read_text())
    text = base64.b64decode(signed["payload"]).decode()
    assert old in text
    signed["payload"] = base64.b64encode(text.replace(old, new).encode()).decode()
    path.write_text(json.dumps(signed))
    assert confirm(capsys) == (1, "", f"Not confirmed: {CHANGED}.\n")


def test_one_of_another_class_is_refused(elsewhere, folder, tmp_path, capsys, monkeypatch):
    other = tmp_path / "other"
    shutil.copytree(folder, other, ignore=shutil.ignore_patterns("signed", ".signing-key"))
    monkeypatch.chdir(other)
    assert main(words(other)) == 0
    shutil.copy(other / "signed" / "receipt.json", elsewhere)
    monkeypatch.chdir(elsewhere)
    wrong = "this receipt was signed with a different key from the one given"
    assert confirm(capsys) == (1, "", f"Not confirmed: {wrong}.\n")


def failed(folder: Path, capsys) -> str:
    """What is printed where there is neither a result nor a receipt."""
    assert main(words(folder)) == 1
    assert not (folder / "r.json").exists()
    return capsys.readouterr().err


@pytest.fixture
def another(folder, tmp_path, monkeypatch) -> Path:
    """A copy of the course, to change; the test runs there."""
    place = tmp_path / "another"
    shutil.copytree(folder, place, ignore=shutil.ignore_patterns("signed", ".signing-key", "r.json"))
    monkeypatch.chdir(place)
    return place


def test_without_the_library_nothing_is_judged(another, capsys, monkeypatch):
    monkeypatch.setattr(receipt_of_one, "find_spec", lambda name: None)
    monkeypatch.setattr("grader.marking.extras.one_submission.cli.judge", None)
    (another / "r.json").write_text("of an earlier submission")
    wrong = "Not judged: receipts need the library securesystemslib: run `make tools`.\n"
    assert failed(another, capsys) == wrong


def test_a_mark_that_needs_a_look_has_no_receipt(another, capsys):
    path = another / "exercises" / ASSIGNMENT / NAME
    notebook = json.loads(path.read_text())
    essay = {"cell_type": "markdown", "id": "essay", "metadata": BY_HAND, "source": "Why?"}
    notebook["cells"].append(essay)
    path.write_text(json.dumps(notebook))
    assert failed(another, capsys) == (
        "Judged, but no result was written: there is no receipt of a mark that still needs a look.\n"
    )
    assert not (another / "signed" / "receipt.json").exists()


def test_a_key_that_others_may_read_signs_nothing(another, capsys):
    (another / ".signing-key").write_text("a key")
    (another / ".signing-key").chmod(0o644)
    assert failed(another, capsys) == (
        "Judged, but no result was written: others may read .signing-key: run `chmod 600 .signing-key`.\n"
    )


def test_a_place_that_cannot_be_written_is_named(another, capsys):
    (another / "signed").write_text("a file")
    assert failed(another, capsys) == (
        "Judged, but no result was written: signed could not be written (File exists).\n"
    )
