"""Reading and changing a platform's CSV file."""
import csv
import io
import random

import pytest

from grader.marking.errors import CourseError
from grader.marking.extras.learning_platform.csv_file import CsvFile

ODD = ["", "Müller", "a,b", "c;d", 'say "hi"', "=1+1", "two\nlines", "\u202bعلي\u202c", " spaced ", "'", "'=x"]


def write(tmp_path, text: str | bytes):
    path = tmp_path / "file.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def failure(tmp_path, text: str | bytes) -> str:
    path = write(tmp_path, text)
    with pytest.raises(CourseError) as caught:
        CsvFile(path)
    return str(caught.value).removeprefix(f"{path}: ")


@pytest.mark.parametrize("begin", ["", "\ufeff"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("quoting", [csv.QUOTE_MINIMAL, csv.QUOTE_ALL])
def test_only_the_changed_cells_differ(tmp_path, begin, delimiter, end, quoting):
    rows = [["id", "grade", "note"], *([f"p{at}", "", text] for at, text in enumerate(ODD))]
    text = io.StringIO(newline="")
    csv.writer(text, delimiter=delimiter, lineterminator=end, quoting=quoting).writerows(rows)
    whole = begin + text.getvalue()
    path = write(tmp_path, whole)
    file = CsvFile(path)
    assert [file.values(at) for at in range(len(rows))] == rows
    assert file.to_bytes() == path.read_bytes()
    for at in range(1, len(rows)):
        file.change(at, 1, "7,5")
    quoted = quoting == csv.QUOTE_ALL or delimiter == ","
    new = '"7,5"' if quoted else "7,5"
    old = '""' if quoting == csv.QUOTE_ALL else ""
    expected = whole
    for at in range(len(ODD)):
        label = f'"p{at}"' if quoting == csv.QUOTE_ALL else f"p{at}"
        expected = expected.replace(f"{label}{delimiter}{old}{delimiter}", f"{label}{delimiter}{new}{delimiter}")
    assert file.to_bytes().decode() == expected


def test_random_tables_are_read_as_the_library_writes_them(tmp_path):
    drawn = random.Random(0)
    for _ in range(200):
        rows = [["a", "b", "c"], *([*drawn.choices([*ODD, '"', '""', ",", "\n"], k=3)] for _ in range(4))]
        text = io.StringIO(newline="")
        csv.writer(text, lineterminator="\r\n").writerows(rows)
        file = CsvFile(write(tmp_path, text.getvalue()))
        rows = [row for row in rows if row != [""]]
        assert [file.values(at) for at in range(len(file.records))] == rows


def test_blank_lines_and_a_missing_last_line_end_stay(tmp_path):
    file = CsvFile(write(tmp_path, "a,b\n\n1,\n\n2,"))
    assert len(file.records) == 3
    file.change(1, 1, "9")
    file.change(2, 1, "8")
    assert file.to_bytes() == b"a,b\n\n1,9\n\n2,8"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "expected columns separated by one of commas, semicolons, tabs; saw no header with any"),
        ("a\n1\n", "expected columns separated by one of commas, semicolons, tabs; saw no header with any"),
        ("a,b;c\n", "expected columns separated by one of commas, semicolons, tabs; saw no header with any"),
        ("a,b\n1,2,3\n", "expected 2 cells in record 2, as in the header, saw 3: take the file as it was exported"),
        ('a,b\n"1"x,2\n', "its quotes are ambiguous: take the file as it was exported"),
        ('a,b\n"1,2\n', "its quotes are ambiguous: take the file as it was exported"),
        (
            "Müller,b\n".encode("latin-1"),
            "expected UTF-8, saw the byte 0xfc at 1: take the file as it was exported",
        ),
        (
            "a,b\n".encode("utf-16"),
            "expected UTF-8, saw the byte 0xff at 0: take the file as it was exported",
        ),
    ],
)
def test_a_file_that_can_t_be_read_is_named_with_what_was_expected(tmp_path, text, sentence):
    assert failure(tmp_path, text) == sentence


def test_two_decimal_marks_are_an_error(tmp_path):
    file = CsvFile(write(tmp_path, "a;b\n7,5;1.5\n"))
    with pytest.raises(CourseError, match="it has numbers with a decimal point and with a decimal comma: export"):
        file.decimal_mark(range(0, 2))
    assert (file.decimal_mark(range(0, 1)), file.decimal_mark(range(1, 2))) == (",", ".")
