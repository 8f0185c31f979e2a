"""A certificate: a page of a student's receipts, which has them inside."""
import json
import re
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from grader.marking.errors import NotConfirmed
from grader.marking.extras.receipts.receipt import MarkReceipt
from grader.marking.page_templates import template_environment

SIGNED = re.compile(r'<script type="application/json" id="receipts">(.*?)</script>', re.DOTALL)


def as_page(receipts: Sequence[MarkReceipt], signed: Sequence[str]) -> str:
    """The page of one student's receipts. signed: the same, as they were signed."""
    data = json.dumps([json.loads(text) for text in signed]).replace("<", "\\u003c")
    newest = max(receipts, key=lambda receipt: receipt.issued)
    return _pages.get_template("certificate.html").render(
        receipts=receipts, newest=newest, day=format_day(newest.issued), signed=data
    )


def signed_in(page: str) -> list[str]:
    """The signed receipts in a page. Raises NotConfirmed."""
    found = SIGNED.search(page)
    try:
        return [json.dumps(each) for each in json.loads(found[1] if found else "")]
    except (TypeError, ValueError, RecursionError):
        raise NotConfirmed("this page has no receipts") from None


def check_page(page: str, receipts: Sequence[MarkReceipt]) -> None:
    """Raise NotConfirmed unless the page is that of these receipts."""
    if len({receipt.student for receipt in receipts}) != 1:
        raise NotConfirmed("the page has receipts of different students")
    if as_page(receipts, signed_in(page)).split() != page.split():
        what = "the receipts on this page are genuine, but the page shows something else"
        raise NotConfirmed(f"{what}: rely only on what is signed, {'; '.join(map(sentence, receipts))}")


def sentence(receipt: MarkReceipt) -> str:
    """Return what a receipt says."""
    who = f"{receipt.name} ({receipt.student}) has {receipt.score} points in {receipt.assignment}"
    return f"{who}, says {receipt.issuer} on {format_day(receipt.issued)}"


def format_day(iso: str) -> str:
    """A date such as 22 November 2026, which is unambiguous in all countries."""
    found = date.fromisoformat(iso)
    return f"{found.day} {found:%B %Y}"


_pages = template_environment(Path(__file__).parent)
