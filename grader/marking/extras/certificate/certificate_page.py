"""Makes and reads the page of a certificate, which is self-contained and fully escaped."""
from html.parser import HTMLParser
from pathlib import Path

from grader.marking.extras.certificate.certificate import Certificate
from grader.marking.page_templates import template_environment

FIELD_ATTRIBUTE = "data-says"  # marks the elements whose text is certified
NUMBER = "certificate number"


def as_page(certificate: Certificate, number: str) -> str:
    """The whole page of a certificate with this number."""
    fields = {NUMBER: number, **certificate.fields()}
    return _pages.get_template("page.html").render(certificate=certificate, fields=fields).lstrip()


def read_page(text: str) -> dict[str, str]:
    """The certified texts on a page, by field: {} for any other page."""
    reader = _Reader()
    reader.feed(text)
    reader.close()
    return reader.fields


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.fields: dict[str, str] = {}
        self._open = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._open = dict(attrs).get(FIELD_ATTRIBUTE) or ""
        if self._open:
            self.fields.setdefault(self._open, "")

    def handle_endtag(self, tag: str) -> None:
        self._open = ""

    def handle_data(self, data: str) -> None:
        if self._open:
            self.fields[self._open] += data


_pages = template_environment(Path(__file__).parent)
