"""`python -m grader confirm`: what agrees with the receipt, and the words for what does not."""
import json
import shutil
from dataclasses import replace

import pytest
from nbgrader.api import Gradebook

from grader.marking.command.cli import main as mark
from grader.marking.extras.certificate import confirm
from grader.marking.extras.certificate.certificate import format_day
from tests.marking.classroom import ASSIGNMENT
from tests.marking.extras.certificate.conftest import (
    ISSUER,
    SCRIPT,
    mark_by_hand,
    marked,
    number,
    write_secret,
)
from tests.marking.fake_pool import ReadyPool


@pytest.fixture
def today(page):
    (line, *_) = json.loads(page.with_name("receipt.json").read_text()).values()
    return format_day(line["certificate"]["issued"])


def refused(*words):
    return 1, "", f"Not confirmed: {''.join(words)}.\n"


def test_a_page_as_it_was_issued_is_confirmed(page, say, today):
    who = f"number {number(page)} was issued to “Anna Meier” (“anna”) on {today}"
    expected = (0, f"Confirmed: {who}, 1 of 1 assignments passed.\n", "")
    assert say("confirm", str(page)) == expected
    page.write_bytes(page.read_bytes().replace(b"\n", b"\r\n"))  # as mail may bring it
    assert say("confirm", str(page)) == expected


def test_of_a_printed_page_the_number_is_enough(page, say, today):
    who = f"number {number(page)} was issued to “Anna Meier” (“anna”) on {today}, 1 of 1 assignments passed"
    compare = f"Compare with the page: {ASSIGNMENT}: 15 of 15"
    assert say("confirm", number(page)) == (0, f"Confirmed: {who}. {compare}.\n", "")


NAME = 'data-says="name">Anna Meier<'
SCORE = f'data-says="score of {ASSIGNMENT}">15 of 15<'
DIGEST = f'data-says="digest of {ASSIGNMENT}">'
FORGED = [
    pytest.param(
        NAME, 'data-says="name">Mallory<',
        "the name is “Mallory” on the page, and was “Anna Meier” when it was issued", id="another name",
    ),
    pytest.param(
        NAME, f'data-says="name">{"M" * 99}\x1b[2J<',
        f"the name is “{'M' * 79}…” on the page, and was “Anna Meier” when it was issued", id="a long name",
    ),
    pytest.param(
        SCORE, SCORE.replace("15 of 15", "16 of 15"),
        f"the score of {ASSIGNMENT} is “16 of 15” on the page, and was “15 of 15” when it was issued",
        id="forged points",
    ),
    pytest.param(
        SCORE, ">15 of 15<",
        f"the page lacks the score of {ASSIGNMENT}, which was “15 of 15” when it was issued",
        id="hidden points",
    ),
    pytest.param(
        "</main>", '<bdi data-says="score of 02_more">9 of 9</bdi></main>',
        "the page has a score of 02_more, which was not there when it was issued", id="one more",
    ),
    pytest.param(
        "passed <bdi", "passed with honours <bdi",
        "name and marks agree, but something else on the page was changed: ask for the file as it was issued",
        id="other words",
    ),
    pytest.param(
        "</style>", "bdi { display: none }</style>",
        "name and marks agree, but something else on the page was changed: ask for the file as it was issued",
        id="another style",
    ),
    pytest.param(
        'number">', 'number">x',
        "no certificate with the number x{number} was issued here", id="another number",
    ),
    pytest.param(
        'number">', 'number">x\x1b',
        "no certificate with the number x {number} was issued here", id="a number for a terminal",
    ),
    pytest.param(
        'data-says="certificate number"', "", "this is not a certificate of this course: it has no number",
        id="no number",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("true", "forged", "words"), FORGED)
def test_a_forged_page_is_refused_with_what_does_not_agree(page, say, true, forged, words):
    text = page.read_text()
    assert text.count(true) == 1
    page.write_text(text.replace(true, forged))
    assert say("confirm", str(page)) == refused(words.replace("{number}", number_of(text)))


def number_of(text):
    return confirm.read_page(text)[confirm.NUMBER]


def test_the_page_of_another_fits_no_other_student(page, say):
    """Eve writes her name into Anna's page, with Anna's number or with her own."""
    eve = page.with_name("eve.html")
    shown = confirm.read_page(eve.read_text())["name"]
    eve.write_text(eve.read_text().replace(number(eve), number(page)))
    words = f"the name is “{shown}” on the page, and was “Anna Meier” when it was issued"
    assert SCRIPT in shown
    assert say("confirm", str(eve)) == refused(words)


def test_the_secret_of_another_class_confirms_nothing(course, page, say):
    write_secret(course.root, "of another class")
    words = f"number {number(page)} was issued with another secret than the one in .secret"
    assert say("confirm", str(page)) == refused(words)
    assert say("certificate", "--issuer", ISSUER)[0] == 0  # goes on with the new one, and keeps the old lines
    assert say("confirm", str(page))[0] == 0
    assert len(json.loads(page.with_name("receipt.json").read_text())) == 4


@pytest.mark.parametrize("change", [{"name": "Mallory"}, {"marks": []}, {"marks": 3}, {"odd": 1}])
def test_a_receipt_that_was_changed_confirms_nothing(page, say, change):
    kept = page.with_name("receipt.json")
    lines = json.loads(kept.read_text())
    lines[number(page)]["certificate"].update(change)
    kept.write_text(json.dumps(lines))
    words = f"the line of number {number(page)} in receipt.json was changed by other hands"
    assert say("confirm", number(page)) == refused(words)


def test_a_mark_that_was_changed_since_is_named(course, page, say, today):
    mark_by_hand(course, 4.5)
    had = f"{ASSIGNMENT} had 15 of 15 points on {today}"
    assert say("confirm", str(page)) == refused(had, ", and has 14.5 of 15 now: the mark was changed since")


def test_the_same_points_marked_again_are_confirmed_and_it_is_reported(course, page, say):
    def again(course, task):
        return replace(marked(course, task), repairs=["Mended."])

    mark([ASSIGNMENT, "--no-feedback", "--force", "--student", "anna"], ReadyPool(course, again).open)
    status, _, wrong = say("confirm", str(page))
    assert (status, wrong.split(", ", 1)[1]) == (1, "and now it still needs a look in the formgrader.\n")
    mark_by_hand(course)
    status, message, _ = say("confirm", str(page))
    assert status == 0
    assert message.endswith(f" passed; marked again since, with the same points: {ASSIGNMENT}.\n")


def test_a_mark_that_is_gone_is_named(course, page, say, today):
    with Gradebook(course.database) as book:
        book.remove_student("anna")
    had = f"{ASSIGNMENT} had 15 of 15 points on {today}"
    assert say("confirm", str(page)) == refused(had, ", and now the gradebook has no mark")


def test_a_class_that_is_over_is_confirmed_from_what_was_kept(course, page, say, tmp_path, monkeypatch):
    kept = tmp_path / "kept"
    kept.mkdir()
    for path in (page, page.with_name("receipt.json"), course.root / ".secret"):
        shutil.copy2(path, kept)
    monkeypatch.chdir(tmp_path)
    shutil.rmtree(course.root)
    assert say("confirm", "kept/anna.html", "--kept", "kept")[0] == 0
    (kept / "receipt.json").unlink()
    words = "there is no receipt.json in kept: nothing was issued, or it is elsewhere"
    assert say("confirm", "kept/anna.html", "--kept", "kept") == refused(words)
    (kept / ".secret").unlink()
    words = "certificates need your secret, and there is no .secret in kept"
    assert say("confirm", "kept/anna.html", "--kept", "kept") == refused(words)


def test_what_is_no_page_and_no_number_is_refused(page, say):
    words = "expected a page, or a number such as 0a1b-2c3d-4e5f-6789, saw “nowhere.html”"
    assert say("confirm", "nowhere.html") == refused(words, " (No such file or directory)")
    words = "no certificate with the number 0000-0000-0000-0000 was issued here"
    assert say("confirm", "0000-0000-0000-0000") == refused(words)
