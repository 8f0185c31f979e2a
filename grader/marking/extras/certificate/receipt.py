"""The instructor's receipt of all certificates, sealed with a key derived from the instructor's secret.

class/certificates/receipt.json has for each number the certificate, a seal of it and one of its page. The
seals are HMACs: without the secret, which is not in the file, no line can be added or changed unnoticed.
"""
import contextlib
import hashlib
import hmac
import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NotConfirmed
from grader.marking.extras.certificate.certificate import Certificate
from grader.marking.extras.certificate.certificate_page import as_page

FILE = "receipt.json"
PURPOSE = b"certificates"  # differs from all other derivations from the secret: those of seeds have a space
PART = 4  # characters of a number between dashes
PARTS = 4


@dataclass(frozen=True)
class IssuedCertificate:
    """A line of the receipt: the certificate, and its page's seal."""

    certificate: Certificate
    page: str


class Receipt:
    """The receipt in a folder, read with a secret. Raises CourseError if it can't be read."""

    def __init__(self, folder: Path, secret: str) -> None:
        self.file = folder / FILE
        self._key = hmac.new(secret.encode(), PURPOSE, hashlib.sha256).digest()
        self._lines: dict[str, dict[str, Any]] = {}
        if self.file.exists():
            try:
                self._lines = json.loads(self.file.read_text(encoding="utf-8"))
                if not all(isinstance(line, dict) for line in self._lines.values()):
                    raise ValueError("expected a table of tables")
            except (OSError, ValueError, AttributeError) as error:
                raise CourseError(f"{self.file} can't be read ({error}): take it from a backup") from None

    def enter(self, certificate: Certificate) -> tuple[str, str]:
        """Add a certificate; return its number and page: the previous ones if only the date is new."""
        for number in self._lines:
            with contextlib.suppress(NotConfirmed):
                known = self.find(number).certificate
                if replace(certificate, issued=known.issued) == known:
                    certificate = known
        seal = self._seal(_text(certificate))
        number = "-".join(seal[at : at + PART] for at in range(0, PART * PARTS, PART))
        page = as_page(certificate, number)
        self._lines[number] = {
            "certificate": certificate.to_data(),
            "seal": seal,
            "page": self.seal_of_page(page),
            "secret": self._fingerprint,
        }
        return number, page

    def write(self) -> None:
        """Write the file, readable by its owner alone. Raises OSError."""
        write_atomically(self.file, json.dumps(self._lines, indent=1, sort_keys=True) + "\n", mode=0o600)

    def find(self, number: str) -> IssuedCertificate:
        """The certificate with this number. Raises NotConfirmed."""
        if number not in self._lines:
            raise NotConfirmed(f"no certificate with the number {number} was issued here")
        line = self._lines[number]
        if line.get("secret") != self._fingerprint:
            raise NotConfirmed(f"number {number} was issued with another secret than the one in .secret")
        try:
            certificate = Certificate.from_data(line["certificate"])
            whole = hmac.compare_digest(line["seal"], self._seal(_text(certificate)))
            issued = IssuedCertificate(certificate, str(line["page"]))
        except (KeyError, TypeError):
            whole = False
        if not whole:
            raise NotConfirmed(f"the line of number {number} in {self.file.name} was changed by other hands")
        return issued

    def seal_of_page(self, page: str) -> str:
        """The seal of a page, independent of its line ends."""
        return self._seal("page " + "\n".join(page.split()))

    @property
    def _fingerprint(self) -> str:
        """Identifies the secret without revealing it."""
        return self._seal("this secret")[: PART * PARTS]

    def _seal(self, text: str) -> str:
        return hmac.new(self._key, text.encode(), hashlib.sha256).hexdigest()


def _text(certificate: Certificate) -> str:
    return json.dumps(certificate.to_data(), sort_keys=True)
