"""`python -m grader verify`: a third party confirms a receipt, and nothing that was tampered with."""
import base64
import contextlib
import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from securesystemslib.signer import CryptoSigner

from grader.marking.extras.receipts import cli, envelope
from grader.marking.extras.receipts.certificate_page import format_day
from grader.marking.extras.receipts.receipt import MARK
from grader.seeds import private_seed, revealed_seeds, secret_of_student
from tests.marking.classroom import ASSIGNMENT, submit
from tests.marking.extras.receipts.conftest import ISSUER
from tests.marking.marked_class import marked

Signed = dict[str, Any]
DAMAGED = "this is not a receipt, or it is damaged"
CHANGED = "the signature does not match: the receipt was changed after it was issued"


@pytest.fixture
def elsewhere(course, receipt, tmp_path, monkeypatch):
    """The folder of a third party: the receipt, the page and the public key, and nothing of the class."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    for path in (receipt, receipt.parents[1] / "anna.html", receipt.parents[1] / "public.pem"):
        shutil.copy(path, folder)
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def confirm(elsewhere, say):
    """Confirms the receipt there with the public key."""
    return lambda *options, name=f"{ASSIGNMENT}.json": say("verify", name, "--key", "public.pem", *options)


def test_a_third_party_confirms_a_receipt_and_a_page(elsewhere, confirm):
    day = format_day(json.loads(payload(read(elsewhere)))["predicate"]["issued"])
    reported = f"Confirmed: Anna Meier (anna) has 15 of 15 points in {ASSIGNMENT}, says {ISSUER} on {day}.\n"
    assert confirm() == confirm(name="anna.html") == (0, reported, "")


def read(folder) -> Signed:
    return json.loads((folder / f"{ASSIGNMENT}.json").read_text())


def payload(signed: Signed) -> str:
    return base64.b64decode(signed["payload"]).decode()


def with_payload(signed: Signed, text: str) -> Signed:
    return signed | {"payload": base64.b64encode(text.encode()).decode()}


def signature(signed: Signed, **changes: str) -> Signed:
    return signed | {"signatures": [signed["signatures"][0] | changes]}


def other_key(signed: Signed) -> Signed:
    return json.loads(envelope.sign(json.loads(payload(signed)), CryptoSigner.generate_ed25519()))


def forged(signed: Signed) -> Signed:
    """Signed with another key that claims to be the instructor's."""
    return signature(other_key(signed), keyid=signed["signatures"][0]["keyid"])


TAMPERED: dict[str, tuple[Callable[[Signed], Any], str]] = {
    "more points": (lambda it: with_payload(it, payload(it).replace('"points": 15.0', '"points": 16.0')), CHANGED),
    "another name": (lambda it: with_payload(it, payload(it).replace("Anna Meier", "Eve Meier")), CHANGED),
    "another submission": (lambda it: with_payload(it, payload(it).replace('"sha256": "', '"sha256": "0')), CHANGED),
    "a space": (lambda it: with_payload(it, payload(it) + " "), CHANGED),
    "another signature": (lambda it: signature(it, sig=base64.b64encode(b"\0" * 64).decode()), CHANGED),
    "a short signature": (lambda it: signature(it, sig="AAAA"), CHANGED),
    "another kind": (lambda it: it | {"payloadType": "application/json"}, CHANGED),
    "another key": (other_key, "this receipt was signed with a different key from the one given"),
    "a forged key": (forged, CHANGED),
    "no signature": (lambda it: it | {"signatures": []}, "this receipt is not signed"),
    "no base64": (lambda it: it | {"payload": "a"}, f"{DAMAGED} (Invalid base64-encoded string"),
    "a field less": (
        lambda it: {"payload": it["payload"], "signatures": it["signatures"]},
        f"{DAMAGED} (it has other fields than payload, payloadType and signatures)",
    ),
    "a field more": (
        lambda it: it | {"points": 15},
        f"{DAMAGED} (it has other fields than payload, payloadType and signatures)",
    ),
    "two of one key": (lambda it: it | {"signatures": it["signatures"] * 2}, f"{DAMAGED} (Multiple signatures found"),
    "no table": (lambda it: [it], f"{DAMAGED} (it has other fields than payload, payloadType and signatures)"),
}


@pytest.mark.parametrize("how", TAMPERED)
def test_what_was_tampered_with_is_refused(elsewhere, confirm, how):
    change, sentence = TAMPERED[how]
    (elsewhere / f"{ASSIGNMENT}.json").write_text(json.dumps(change(read(elsewhere))))
    status, output, wrong = confirm()
    assert (status, output) == (1, "")
    expected = f"Not confirmed: {sentence}"
    assert wrong.startswith(expected) if "(" in sentence and not sentence.endswith(")") else wrong == f"{expected}.\n"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", f"{DAMAGED} (Expecting value: line 1 column 1 (char 0))"),
        ("{", f"{DAMAGED} (Expecting property name enclosed in double quotes: line 1 column 2 (char 1))"),
        ("<html>", "this page has no receipts"),
        ('<script type="application/json" id="receipts">{</script>', "this page has no receipts"),
        ('<script type="application/json" id="receipts">[]</script>', "the page has receipts of different students"),
    ],
)
def test_a_file_that_is_no_receipt_is_refused(elsewhere, confirm, text, sentence):
    (elsewhere / "file").write_text(text)
    assert confirm(name="file") == (1, "", f"Not confirmed: {sentence}.\n")


@pytest.mark.parametrize(
    ("old", "new"), [("15 of 15", "16 of 16"), ("Anna Meier</bdi>", "Eve</bdi>"), ("</main>", "<p>With honors</p></main>")]
)
def test_a_page_that_shows_more_than_its_receipts_is_refused(elsewhere, confirm, old, new):
    page = elsewhere / "anna.html"
    page.write_text(page.read_text().replace(old, new))
    status, output, wrong = confirm(name="anna.html")
    assert (status, output) == (1, "")
    what = "the receipts on this page are genuine, but the page shows something else"
    assert wrong.startswith(
        f"Not confirmed: {what}: rely only on what is signed, Anna Meier (anna) has 15 of 15 points in {ASSIGNMENT}, says"
    )


def sign_as_instructor(course, statement: Any, elsewhere) -> None:
    signer = envelope.make_keys(course.root / envelope.PRIVATE, course.receipts() / envelope.PUBLIC)
    (elsewhere / f"{ASSIGNMENT}.json").write_text(envelope.sign(statement, signer))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda it: it | {"predicateType": "x"}, "what was signed is not a mark of this course (x)"),
        (lambda it: {"predicateType": MARK}, "what was signed is not a mark of this course ('_type')"),
        (lambda it: [], "what was signed is not a mark of this course (list indices must be integers or slices, not str)"),
        (
            lambda it: it | {"predicate": it["predicate"] | {"seeds": {"counter": [1]}, "nonce": "0"}},
            "the seeds are not those that were sealed when the mark was given",
        ),
    ],
)
def test_what_is_signed_must_be_a_mark(course, elsewhere, confirm, change, sentence):
    sign_as_instructor(course, change(json.loads(payload(read(elsewhere)))), elsewhere)
    assert confirm() == (1, "", f"Not confirmed: {sentence}.\n")


def test_a_signed_text_of_another_kind_is_no_receipt(course, elsewhere, confirm, monkeypatch):
    monkeypatch.setattr(envelope, "KIND", "text/plain")
    sign_as_instructor(course, {}, elsewhere)
    monkeypatch.undo()
    monkeypatch.chdir(elsewhere)
    reported = "what was signed is not an in-toto statement but 'text/plain'"
    assert confirm() == (1, "", f"Not confirmed: {reported}.\n")


def test_a_key_or_a_file_that_is_not_there_is_named(elsewhere, say, monkeypatch):
    key = "expected the instructor's public key, saw"
    name = f"{ASSIGNMENT}.json"
    reported = f"Not confirmed: {key} class/receipts/public.pem (No such file or directory).\n"
    assert say("verify", name) == (1, "", reported)
    assert say("verify", name, "--key", name) == (1, "", f"Not confirmed: {key} {name}, which is not one.\n")
    reported = "Not confirmed: expected a receipt, saw no (No such file or directory).\n"
    assert say("verify", "no", "--key", "public.pem") == (1, "", reported)
    (elsewhere / "bytes").write_bytes(b"\xff")
    reported = "Not confirmed: expected a receipt, saw bytes (it is not text).\n"
    assert say("verify", "bytes", "--key", "public.pem") == (1, "", reported)
    monkeypatch.setattr(cli, "find_spec", lambda name: None)
    assert say("verify", name) == (1, "", f"Not confirmed: {cli.LIBRARY}.\n")


class SeededPool:
    """A pool that gives anna's result, and knows the secret that it was opened with."""

    def __init__(self, course, **changes: Any) -> None:
        self.course, self.changes, self.secret = course, changes, None

    def open(self, secret: str):
        self.secret = secret
        return contextlib.nullcontext(self)

    def mark(self, tasks):
        for task in tasks:
            result = marked(self.course, task)
            (note,) = result.notebooks
            cells = [replace(cell, **self.changes.get(cell.cell, {})) for cell in note.cells]
            left = [cell for cell in cells if cell.cell not in self.changes.get("without", ())]
            yield replace(result, notebooks=[replace(note, cells=left)], **self.changes.get("result", {}))


@pytest.fixture
def again(course, elsewhere, capsys):
    """Marks anna's submission again there."""

    def run(pool: SeededPool, *options: str) -> tuple[int, str, str]:
        capsys.readouterr()
        folders = ["--submission", str(course.submitted("anna", ASSIGNMENT)), "--release", str(course.release(ASSIGNMENT))]
        status = cli.verify([f"{ASSIGNMENT}.json", "--key", "public.pem", *folders, *options], pool.open)
        output, wrong = capsys.readouterr()
        return status, output.partition("\n")[2], wrong

    return run


SAME = "Submission and release are those that were marked.\n"
EQUAL = "Marked again, with equal points and recordings: 10 in 2 test cells.\n"


def test_with_revealed_seeds_anybody_can_mark_again(course, elsewhere, again, issue, monkeypatch):
    sealed = "the seeds of its worlds are sealed, so it can't be marked again here: the instructor reveals them"
    assert again(SeededPool(course)) == (
        *(1, SAME),
        f"Not confirmed: {sealed} with `python -m grader receipts --reveal`.\n",
    )
    monkeypatch.chdir(course.root)
    assert issue("--reveal")[0] == 0
    shutil.copy(course.receipts() / "anna" / f"{ASSIGNMENT}.json", elsewhere)
    monkeypatch.chdir(elsewhere)
    pool = SeededPool(course)
    assert again(pool) == (0, SAME + EQUAL, "")
    own = secret_of_student("of this class", "anna")
    given = secret_of_student(pool.secret, "anna")
    assert private_seed(given, "counter", 0) == private_seed(own, "counter", 0)


def test_the_instructor_marks_again_with_the_secret(course, again, monkeypatch):
    for name in (f"{ASSIGNMENT}.json", "public.pem"):
        shutil.copy(name, course.root)
    monkeypatch.chdir(course.root)
    pool = SeededPool(course)
    assert again(pool) == (0, SAME + EQUAL, "")
    assert pool.secret == "of this class"


@pytest.mark.parametrize(
    ("changes", "lines"),
    [
        ({"test_line": {"points": 5.5}}, ["nodes/test_line has 5.5 points now, and 6 in the receipt"]),
        ({"without": ["test_line"]}, ["nodes/test_line has no points now, and 6 in the receipt"]),
        ({"test_line": {"digests": ["0"]}}, ["nodes/test_line has the same points, from other recordings"]),
        (
            {"without": ["test_line", "test_counter"], "result": {"verdict": "refused", "reason": "It hung."}},
            [
                "it was refused: It hung",
                "nodes/test_counter has no points now, and 4 in the receipt",
                "nodes/test_line has no points now, and 6 in the receipt",
            ],
        ),
    ],
)
def test_where_marking_again_differs_is_listed(course, again, monkeypatch, changes, lines):
    shutil.copy(course.root / ".secret", ".")
    listed = "\n".join(["Marked again, with differences:", *(f"  {line}" for line in lines)])
    assert again(SeededPool(course, **changes)) == (1, SAME, f"{listed}.\n")


def test_another_submission_or_release_is_refused(course, again):
    submit(course, "anna", line="Line = 3")
    folder = course.submitted("anna", ASSIGNMENT)
    reported = f"{folder} is not the submission that was marked: its digest differs"
    assert again(SeededPool(course)) == (1, "", f"Not confirmed: {reported}.\n")
    (course.release(ASSIGNMENT) / "more.txt").write_text("more")
    reported = f"{course.release(ASSIGNMENT)} is not the release that was marked: its digest differs"
    assert again(SeededPool(course)) == (1, "", f"Not confirmed: {reported}.\n")


def test_other_versions_are_named(course, elsewhere, again):
    shutil.copy(course.root / ".secret", ".")
    statement = json.loads(payload(read(elsewhere)))
    statement["predicate"]["versions"]["Python"] = "3.0"
    statement["subject"][1]["digest"]["sha256"] = "0"
    sign_as_instructor(course, statement, elsewhere)
    status, output, wrong = again(SeededPool(course))
    assert (status, wrong) == (0, "")
    first, second, *_ = output.removeprefix(SAME).splitlines()
    assert first == "requirements.lock is different here: points may differ."
    assert second.startswith("Python is 3.") and second.endswith(" here, and was 3.0: points may differ.")


def test_a_page_of_several_is_not_marked_again(course, confirm, elsewhere, say, monkeypatch):
    with pytest.raises(SystemExit, match="2"):
        confirm("--submission", "x")
    monkeypatch.setattr(cli, "_confirmed", lambda path, key: [])
    reported = "Not confirmed: expected one receipt to mark again, saw a page of several.\n"
    assert confirm("--submission", "x", "--release", "y") == (1, "", reported)


def test_revealed_seeds_are_a_secret_that_gives_them():
    seeds = {"counter": [3, 5], "line": [7]}
    own = secret_of_student(revealed_seeds(seeds), "anna")
    assert [private_seed(own, "counter", 1), private_seed(own, "line", 0, [1, 2])] == [5, 7]
