"""The content of a receipt: a student's mark, what it was given for, and what is needed to give it again."""
from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, field
from typing import Any

from grader.marking.errors import NotConfirmed
from grader.page import format_points

STATEMENT = "https://in-toto.io/Statement/v1"
MARK = "urn:ros2-notebook-course:mark:1"


@dataclass(frozen=True)
class ReceiptCell:
    """A test cell: its points as marking gave them, and the digests of the recordings that were judged."""

    cell: str
    exercise: str
    points: float
    most: float
    recordings: tuple[str, ...]


@dataclass(frozen=True)
class MarkReceipt:
    """A mark. points: with those given by hand and late penalties. issued: YYYY-MM-DD.

    digests: SHA-256 of the submission, the release and requirements.lock, by name. versions: of what marked.
    seal: SHA-256 of the private seeds and a nonce; "" where seeds are public. seeds, nonce: what is sealed,
    by exercise, in a receipt that reveals it.
    """

    student: str
    name: str
    assignment: str
    points: float
    most: float
    issuer: str
    issued: str
    cells: tuple[ReceiptCell, ...]
    digests: dict[str, str]
    versions: dict[str, str]
    seal: str = ""
    nonce: str = ""
    seeds: dict[str, list[int]] = field(default_factory=dict)

    @property
    def score(self) -> str:
        """The points, as "8 of 10"."""
        return f"{format_points(self.points)} of {format_points(self.most)}"

    def statement(self) -> dict[str, Any]:
        """Return it as an in-toto statement."""
        about = asdict(self)
        digests = about.pop("digests")
        subject = [{"name": name, "digest": {"sha256": digests[name]}} for name in sorted(digests)]
        return {"_type": STATEMENT, "subject": subject, "predicateType": MARK, "predicate": about}

    @staticmethod
    def from_statement(data: Any) -> MarkReceipt:
        """From a signed statement. Raises NotConfirmed for anything but a mark."""
        try:
            if (data["_type"], data["predicateType"]) != (STATEMENT, MARK):
                raise ValueError(data["predicateType"])
            about = dict(data["predicate"])
            rows = [{**row, "recordings": tuple(row["recordings"])} for row in about.pop("cells")]
            cells = tuple(ReceiptCell(**row) for row in rows)
            digests = {each["name"]: each["digest"]["sha256"] for each in data["subject"]}
            receipt = MarkReceipt(**about, cells=cells, digests=digests)
        except (TypeError, KeyError, ValueError, AttributeError) as error:
            raise NotConfirmed(f"what was signed is not a mark of this course ({error})") from None
        if receipt.seeds and receipt.seal != seal_of(receipt.nonce, receipt.seeds):
            raise NotConfirmed("the seeds are not those that were sealed when the mark was given")
        return receipt


def seal_of(nonce: str, seeds: dict[str, list[int]]) -> str:
    """The seal of private seeds; without the nonce they can't be found by trying."""
    return hashlib.sha256(f"{nonce} {json.dumps(seeds, sort_keys=True)}".encode()).hexdigest()
