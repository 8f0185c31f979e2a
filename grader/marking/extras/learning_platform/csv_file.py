"""A CSV file that a platform exported: cells can be changed, and every other byte stays as it is."""
import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path

from grader.marking.errors import CourseError

DELIMITERS = {",": "commas", ";": "semicolons", "\t": "tabs"}
BOM = "\ufeff"
NUMBER = re.compile(r"\d+([.,]\d+)?")


@dataclass(frozen=True)
class CsvCell:
    """A cell: its value, and where its text begins and ends in the file, with quotes."""

    value: str
    begin: int
    end: int


class CsvFile:
    """A file with a header and rows of as many cells. Raises CourseError, OSError."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._text = path.read_bytes().decode()
        except UnicodeDecodeError as error:
            saw = f"saw the byte 0x{error.object[error.start]:02x} at {error.start}"
            raise self.problem(f"expected UTF-8, {saw}: take the file as it was exported") from None
        self.delimiter, self.records = self._parse()
        self._changes: dict[CsvCell, str] = {}

    @property
    def header(self) -> list[str]:
        """The titles of the columns."""
        return self.values(0)

    def values(self, record: int) -> list[str]:
        """The values of a record; the header is record 0."""
        return [cell.value for cell in self.records[record]]

    def change(self, record: int, column: int, value: str) -> None:
        """Set the value of a cell; it is quoted if needed, or if it was quoted before."""
        cell = self.records[record][column]
        quoted = self._text[cell.begin : cell.begin + 1] == '"' or self.delimiter in value
        self._changes[cell] = '"' + value.replace('"', '""') + '"' if quoted else value

    def new_value(self, record: int, column: int) -> str:
        """The text of a cell after all changes, as it is in the file."""
        cell = self.records[record][column]
        return self._changes.get(cell, self._text[cell.begin : cell.end])

    def to_bytes(self) -> bytes:
        """The file with all changes."""
        parts, at = [], 0
        for cell in sorted(self._changes, key=lambda cell: cell.begin):
            parts += [self._text[at : cell.begin], self._changes[cell]]
            at = cell.end
        return "".join([*parts, self._text[at:]]).encode()

    def decimal_mark(self, columns: range) -> str:
        """The decimal mark of the numbers in these columns, or "" if all are whole numbers."""
        cells = (cell.value for record in self.records[1:] for cell in record[columns.start : columns.stop])
        found = {match[1][0] for match in map(NUMBER.fullmatch, cells) if match and match[1]}
        if len(found) > 1:
            raise self.problem("it has numbers with a decimal point and with a decimal comma: export it "
                               "again")
        return found.pop() if found else ""

    def problem(self, text: str) -> CourseError:
        """An error that names the file."""
        return CourseError(f"{self.path}: {text}")

    def _parse(self) -> tuple[str, list[list[CsvCell]]]:
        found = {mark: _records(self._text, mark) for mark in DELIMITERS}
        widths = {mark: len(records[0]) if records else 0 for mark, records in found.items()}
        best = max(widths, key=lambda mark: widths[mark])
        if widths[best] < 2 or list(widths.values()).count(widths[best]) > 1:
            kinds = ", ".join(DELIMITERS.values())
            raise self.problem(f"expected columns separated by one of {kinds}; saw no header with any")
        records = [record for record in found[best] if [cell.value for cell in record] != [""]]
        if [[cell.value for cell in record] for record in records] != self._by_library(best):
            raise self.problem("its quotes are ambiguous: take the file as it was exported")
        for number, record in enumerate(records, 1):
            if len(record) != len(records[0]):
                expected = f"expected {len(records[0])} cells in record {number}, as in the header"
                raise self.problem(f"{expected}, saw {len(record)}: take the file as it was exported")
        return best, records

    def _by_library(self, delimiter: str) -> list[list[str]] | None:
        """The values of all records, read by the standard library."""
        text = io.StringIO(self._text.removeprefix(BOM), newline="")
        try:
            rows = list(csv.reader(text, delimiter=delimiter, strict=True))
        except csv.Error:
            return None
        return [row for row in rows if row not in ([], [""])]


def _records(text: str, delimiter: str) -> list[list[CsvCell]]:
    """All records with positions; where the quotes are wrong, fewer than there are."""
    pattern = re.compile(rf'("(?:[^"]|"")*"|[^{delimiter}\r\n]*)({delimiter}|\r\n|\n|\r|\Z)')
    records: list[list[CsvCell]] = [[]]
    at = len(BOM) if text.startswith(BOM) else 0
    while at < len(text) and (match := pattern.match(text, at)):
        raw = match[1]
        value = raw[1:-1].replace('""', '"') if raw.startswith('"') else raw
        records[-1].append(CsvCell(value, *match.span(1)))
        at = match.end()
        if match[2] == delimiter and at == len(text):
            records[-1].append(CsvCell("", at, at))
        elif match[2] != delimiter:
            records.append([])
    return [record for record in records if record]
