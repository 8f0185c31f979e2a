"""The grade column and the people in a file that Moodle or Canvas exported."""
import re
from collections.abc import Collection
from dataclasses import dataclass, field

from grader.marking.extras.learning_platform.csv_file import NUMBER, CsvFile
from grader.marking.extras.learning_platform.platform_users import PlatformUser

NO = {"no", "nein", "non", "nee", "não", "nej", "nei", "nie", "ne"}  # in Moodle
EXCUSED = "EX"  # in Canvas
COMPUTED = re.compile(r"(Current|Final|Unposted|Override)\b.*\b(Score|Grade|Points|Status)\b.*")
NUMBERED = re.compile(r"(.*?)\s*\((\d+)\)")


@dataclass(frozen=True)
class GradeSheet:
    """A file with one grade column.

    people: by record. column: that of the grades. most: the platform's maximum. decimal: its decimal mark.
    fixed: why the grade of a record can't be changed.
    """

    file: CsvFile
    people: dict[int, PlatformUser]
    column: int
    most: float
    decimal: str
    fixed: dict[int, str] = field(default_factory=dict)

    def fill(self, record: int, points: float) -> str:
        """Enter points; return the text that was there before if it is another number."""
        text = f"{points:.2f}".rstrip("0").rstrip(".")
        before = self.file.values(record)[self.column]
        if not _is_number(before) or _number(before) != float(text):
            self.file.change(record, self.column, text.replace(".", self._mark(text)))
            return before if _is_number(before) else ""
        return ""

    def _mark(self, text: str) -> str:
        if "." in text and not self.decimal and self.file.delimiter == ";":
            raise self.file.problem(
                f"expected a number that shows whether {text} has a point or a comma, saw none: "
                "give --decimal . or --decimal ,"
            )
        return self.decimal or "."


def read_moodle(file: CsvFile, column: str = "", decimal: str = "") -> GradeSheet:
    """Read a grading worksheet of Moodle, in any language. column: the title of the grades."""
    records = range(1, len(file.records))
    found = ((at, re.fullmatch(r"(\D*)(\d+)", file.values(at)[0])) for at in records)
    numbers = {at: match for at, match in found if match}
    if not records or len(numbers) < len(records) or len({match[1] for match in numbers.values()}) > 1:
        bad = next((file.values(at)[0] for at in records if at not in numbers), "different words")
        saw = f"saw {bad!r}" if records else "saw no rows"
        expected = "expected a worksheet with `Participant 123` or the like in its first column"
        raise file.problem(f"{expected}, {saw}: download it with View all submissions, Grading worksheet")
    grade = _titled(file, column, range(2, len(file.header) - 1)) if column else _before_maximum(file)
    most = {file.values(at)[grade + 1] for at in records}
    if len(most) > 1 or not all(map(_is_number, most)):
        title = file.header[grade + 1]
        raise file.problem(
            f"expected one maximum in the column {title!r}, after the grades, saw {_some(most)}: an "
            "assignment that gives points has it"
        )
    people = {at: _moodle_person(file.values(at), numbers[at][2], grade) for at in records}
    locked = {at: "is locked in Moodle" for at in records if _is_locked(file.values(at), grade)}
    mark = decimal or file.decimal_mark(range(grade, grade + 2))
    return GradeSheet(file, people, grade, _number(most.pop()), mark, locked)


def read_canvas(
    file: CsvFile, column: str = "", titles: Collection[str] = (), decimal: str = ""
) -> GradeSheet:
    """Read Canvas's gradebook export. column: the title of the grades; if "", it is one of `titles`."""
    header = [title.strip() for title in file.header]
    if "ID" not in header[1:3] or "Section" not in header:
        saw = ", ".join(header[:6])
        expected = "expected the columns Student, ID and Section"
        raise file.problem(f"{expected}, saw {saw}: export the gradebook of Canvas")
    number, last = header.index("ID"), header.index("Section")
    choice = range(last + 1, len(header))
    grade = _titled(file, column, choice) if column else _canvas_column(file, titles, choice)
    records = range(1, len(file.records))
    people = {at: _canvas_person(file.values(at), number, last) for at in records}
    people = {at: person for at, person in people.items() if person.number}
    most = [file.values(at)[grade] for at in records if at not in people]
    points = [text for text in most if _is_number(text)]
    if len(points) != 1:
        saw = _some(most) if most else "no such row"
        expected = f"expected the possible points of {header[grade]!r} above the students"
        raise file.problem(f"{expected}, saw {saw}: export the gradebook of Canvas again")
    excused = {
        at: "is excused in Canvas" for at in people if file.values(at)[grade].strip().upper() == EXCUSED
    }
    return GradeSheet(file, people, grade, _number(points[0]), decimal or file.decimal_mark(choice), excused)


def _before_maximum(file: CsvFile) -> int:
    """The column of the grades: the next one has the same number in each row."""
    rows = [file.values(at) for at in range(1, len(file.records))]
    found = [
        at
        for at in range(2, len(file.header) - 1)
        if len({row[at + 1] for row in rows}) == 1 and _is_number(rows[0][at + 1])
        if all(row[at].strip() in ("", "-") or _is_number(row[at]) for row in rows)
    ]
    if len(found) != 1:
        saw = " or ".join(repr(file.header[at]) for at in found) or "none"
        expected = "expected one column of grades with the maximum after it"
        raise file.problem(f"{expected}, saw {saw}: name it with --column")
    return found[0]


def _canvas_column(file: CsvFile, titles: Collection[str], choice: range) -> int:
    plain = {at: _title(file.header[at]) for at in choice if not COMPUTED.fullmatch(file.header[at].strip())}
    found = [at for at, title in plain.items() if title in titles]
    if len(found) != 1:
        expected = f"expected one column titled {' or '.join(map(repr, titles))}"
        saw = ", ".join(repr(file.header[at]) for at in found or plain) or "no assignments"
        raise file.problem(f"{expected}, saw {saw}: name it with --column")
    return found[0]


def _titled(file: CsvFile, column: str, choice: range) -> int:
    found = [at for at in choice if column in (file.header[at].strip(), _title(file.header[at]))]
    if len(found) != 1:
        saw = f"saw {len(found)}" if found else f"saw {', '.join(repr(file.header[at]) for at in choice)}"
        raise file.problem(f"expected one column for grades titled {column!r}, {saw}")
    return found[0]


def _title(header: str) -> str:
    match = NUMBERED.fullmatch(header.strip())
    return match[1] if match else header.strip()


def _moodle_person(row: list[str], number: str, grade: int) -> PlatformUser:
    """The name is in the second column; what follows it, up to the grade, may identify a person."""
    return PlatformUser(row[1], number, tuple(cell for cell in row[2:grade] if cell.strip()))


def _canvas_person(row: list[str], number: int, last: int) -> PlatformUser:
    ids = tuple(cell for cell in row[number + 1 : last] if cell.strip())
    return PlatformUser(" ".join(row[:number]).strip(), row[number].strip(), ids)


def _is_locked(row: list[str], grade: int) -> bool:
    return len(row) > grade + 2 and row[grade + 2].strip().casefold() in NO


def _is_number(text: str) -> bool:
    return NUMBER.fullmatch(text.strip()) is not None


def _number(text: str) -> float:
    return float(text.strip().replace(",", "."))


def _some(texts: Collection[str]) -> str:
    return ", ".join(sorted(map(repr, texts))[:3])
