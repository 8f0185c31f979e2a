"""Reads when students handed in from Moodle's worksheet, which has times as sentences, in any language."""
import functools
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime

from babel import Locale
from babel.localedata import locale_identifiers

from grader.marking.extras.learning_platform.csv_file import CsvFile
from grader.marking.extras.learning_platform.grade_sheet import GradeSheet

NONE = {"", "-"}
TIME, YEAR = re.compile(r"(?<!\d)(\d{1,2}):(\d{2})(?::\d{2})?(?!\d)"), re.compile(r"(?<!\d)\d{4}(?!\d)")
NUMERIC = re.compile(r"(?<!\d)(\d{4})\D{1,3}(\d{1,2})\D{1,3}(\d{1,2})(?!\d)")  # year, month, day
DAY = re.compile(r"(?<!\d)\d{1,2}(?!\d)")
HALF = re.compile(r"\b([ap])\.?\s?m\b", re.IGNORECASE)


@dataclass(frozen=True)
class Names:
    """The names of a language's months or weekdays, with numbers; the pattern finds the longest in a text."""

    numbers: Mapping[str, int]
    pattern: re.Pattern[str]

    def find(self, text: str) -> set[int]:
        """The numbers of all names in a text in lower case."""
        return {self.numbers[name] for name in self.pattern.findall(text)}


def submission_times(sheet: GradeSheet) -> dict[str, datetime]:
    """Return when people handed in (UTC), by the platform's number; {} if the worksheet doesn't say it.

    Moodle has these times before those of the grades. Raises CourseError.
    """
    file = sheet.file
    for column in range(sheet.column + 2, len(file.header)):
        cells = {who.number: file.values(at)[column].strip() for at, who in sheet.people.items()}
        if all(cell in NONE or (TIME.search(cell) and YEAR.search(cell)) for cell in cells.values()):
            known = _parse({*cells.values()} - NONE, file, column)
            return {number: known[cell] for number, cell in cells.items() if cell in known}
    return {}


def _parse(cells: Collection[str], file: CsvFile, column: int) -> dict[str, datetime]:
    """The time of each cell, in the one language that fits all of them."""
    if not cells:
        return {}
    readings = (_read_all(cells, *language) for language in _languages())
    found = {tuple(sorted(each.items())) for each in readings if each}
    if len(found) != 1:
        raise file.problem(
            f"the times in the column {file.header[column]!r} can't be read, such as {min(cells)!r}: "
            "export it with Moodle in English"
        )
    return dict(found.pop())


def _read_all(cells: Collection[str], months: Names, weekdays: Names) -> dict[str, datetime]:
    """The time of each cell in a language; {} if one is no time in it."""
    found = {}
    for cell in cells:
        when = _read(cell, months, weekdays)
        if when is None:
            return {}
        found[cell] = when
    return found


def _read(cell: str, months: Names, weekdays: Names) -> datetime | None:
    """A time in a language, if its weekday is right."""
    clock = TIME.search(cell)
    if clock is None:
        return None
    date = TIME.sub(" ", cell).casefold()
    numeric = NUMERIC.search(date)
    if numeric:
        year, month, day = map(int, numeric.groups())
    else:
        named, days = months.find(date), DAY.findall(YEAR.sub(" ", months.pattern.sub(" ", date)))
        years = YEAR.findall(date)
        if len(named) != 1 or len(days) != 1 or not years:
            return None
        year, month, day = int(years[0]), named.pop(), int(days[0])
    half = HALF.search(cell)
    hour = int(clock[1]) % 12 + 12 * (half[1] in "pP") if half else int(clock[1])
    try:
        when = datetime(year, month, day, hour, int(clock[2]))
    except ValueError:
        return None
    right = numeric or weekdays.find(date) == {when.weekday()}
    return when.astimezone(UTC).replace(tzinfo=None) if right else None


@functools.cache
def _languages() -> list[tuple[Names, Names]]:
    """The months and weekdays of all languages of Unicode's tables."""
    locales = (Locale.parse(name) for name in locale_identifiers() if "_" not in name)
    return [(_names(locale.months), _names(locale.days)) for locale in locales]


def _names(table: Mapping[str, Mapping[str, Mapping[int, str]]]) -> Names:
    numbers = {
        name.casefold(): number
        for use in ("format", "stand-alone")
        for width in ("wide", "abbreviated")
        for number, name in table[use][width].items()
    }
    longest = sorted(map(re.escape, numbers), key=len, reverse=True)
    return Names(numbers, re.compile(rf"(?<!\w)(?:{'|'.join(longest)})(?!\w)"))
