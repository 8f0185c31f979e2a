"""`python -m grader grades`: marks filled into files of Moodle and Canvas."""
import csv
import io
import random
import re
import stat

import pytest
from nbgrader.api import Gradebook

from grader.marking.extras.learning_platform.csv_file import CsvFile
from grader.marking.extras.learning_platform.fill_grades import PlatformMark, fill_grades
from grader.marking.extras.learning_platform.grade_sheet import read_canvas, read_moodle
from grader.marking.extras.learning_platform.platform_users import KnownStudent
from tests.marking.classroom import ASSIGNMENT
from tests.marking.extras.learning_platform.exports import CANVAS, ENGLISH, GERMAN, canvas, moodle, php_csv
from tests.marking.marked_class import mark_by_hand

ANNA, BOB, EVE = (11, "Anna Meier", "anna@example.org"), (12, "bob", "b@example.org"), (13, "Eve", "eve")


def write(course, text: str, name: str = "sheet.csv"):
    path = course.root / name
    path.write_bytes(text.encode())
    return path


def column(text: str, at: int, delimiter: str = ",") -> list[str]:
    return [row[at] for row in csv.reader(io.StringIO(text), delimiter=delimiter)]


def others(text: str, at: int, delimiter: str = ",") -> list[list[str]]:
    return [row[:at] + row[at + 1 :] for row in csv.reader(io.StringIO(text), delimiter=delimiter)]


def test_a_worksheet_is_filled_in_place_and_nothing_else_is_touched(course, say):
    text = "\ufeff" + moodle([ANNA, BOB, EVE]).replace("Weiter so", "=1+1").replace("\n", "\r\n")
    path = write(course, text)
    path.chmod(0o640)
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    assert (status, output, wrong) == (0, "sheet.csv: 3 grades filled in, in the column 'Grade'.\n", "")
    filled = path.read_bytes().decode()
    assert column(filled[1:], 4) == ["Grade", "15", "0", "15"]
    assert re.sub(r",(15|0),15\.00", ",,15.00", filled) == text
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert say("grades", ASSIGNMENT, "--moodle", "sheet.csv")[0] == 0
    assert path.read_bytes().decode() == filled


def test_german_words_and_a_decimal_comma_are_kept(course, say):
    mark_by_hand(course, 3.5)
    path = write(course, moodle([ANNA, BOB, EVE], GERMAN, "15,00"))
    status, output, _ = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    assert (status, output) == (0, "sheet.csv: 3 grades filled in, in the column 'Bewertung'.\n")
    assert column(path.read_text(), 4) == ["Bewertung", "13,5", "0", "13,5"]
    assert ',"13,5","15,00",' in path.read_text()


def test_everyone_who_is_left_out_is_listed(course, say):
    people = [ANNA, (21, "Karl, der", "k@example.org"), EVE, (14, "Eve", "eve")]
    path = write(course, moodle(people))
    with Gradebook(course.database, course.name) as book:
        book.find_submission(ASSIGNMENT, "anna").notebooks[0].grades[0].needs_manual_grade = True
        book.db.commit()
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    assert (status, output) == (1, "sheet.csv: 0 grades filled in, in the column 'Grade'.\n")
    assert wrong.splitlines() == [
        f"  anna: {ASSIGNMENT} still needs a look in the formgrader, and is not filled in.",
        "  Karl, der (21, k@example.org): unknown to the gradebook.",
        "  Eve (13, eve): may be eve, and is not filled in.",
        "  Eve (14, eve): may be eve, and is not filled in.",
        "  bob: has a mark, and is not in the file.",
    ]
    assert path.read_text() == moodle(people)


def test_a_locked_grade_stays_and_another_one_is_replaced_and_listed(course, say):
    text = moodle([ANNA], can="No", grade="3.00") + moodle([BOB], grade="2.00").partition("\n")[2]
    text += moodle([EVE], grade="15.0").partition("\n")[2]
    path = write(course, text)
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    counted = "sheet.csv: 2 grades filled in, in the column 'Grade'.\n"
    assert (status, output) == (1, f"{counted}  bob: had 2.00, and has 0 now.\n")
    assert wrong == "  anna: is locked in Moodle, and is not filled in.\n"
    assert column(path.read_text(), 4) == ["Grade", "3.00", "0", "15.0"]


def test_canvas_s_export_is_filled_in_by_login_and_by_name(course, say):
    people = [
        ("Meier, Anna", "1001", "S1", "anna@example.org", "EX", "9.0"),
        ('O"Hara, =1+1', "1002", "S2", "bob", "1.0", ""),
        ("Eve", "1003", "eve", "", "", ""),
        ("Student, Test", "1004", "", "abc", "", ""),
    ]
    path = write(course, canvas(people))
    before = others(path.read_text(), 5)
    status, output, wrong = say("grades", ASSIGNMENT, "--canvas", "sheet.csv")
    counted = "sheet.csv: 2 grades filled in, in the column '01_class (4711)'.\n"
    assert (status, output) == (1, f"{counted}  bob: had 1.0, and has 0 now.\n")
    assert wrong.splitlines() == [
        "  anna: is excused in Canvas, and is not filled in.",
        "  Student, Test (1004, abc): unknown to the gradebook.",
    ]
    assert column(path.read_text(), 5) == ["01_class (4711)", "15.0", "EX", "0", "15", ""]
    assert others(path.read_text(), 5) == before


def test_canvas_with_semicolons_a_decimal_comma_and_separate_names(course, say):
    mark_by_hand(course, 3.5)
    header = ("LastName", "FirstName", "ID", "SIS User ID", "SIS Login ID", "Section", "01_class (4711)")
    rows = [header, ("  Points Possible", "", "", "", "", "", "15,00"), ("Meier", "Anna", "7", "", "", "A", "")]
    path = write(course, php_csv(rows, ";"))
    assert say("grades", ASSIGNMENT, "--canvas", "sheet.csv")[0] == 1
    assert column(path.read_text(), 6, ";") == ["01_class (4711)", "15,00", "13,5"]


def test_a_course_total_is_the_sum_of_all_marks(course, say):
    header = [*CANVAS[:5], "Course total (9)", *CANVAS[6:]]
    path = write(course, canvas([("x", "1", "", "anna")], header))
    assert say("grades", "--total", "--canvas", "sheet.csv")[0] == 1
    assert column(path.read_text(), 5)[2] == "15"
    worksheet = write(course, moodle([ANNA]), "total.csv")
    assert say("grades", "--total", "--moodle", "total.csv")[0] == 1
    assert column(worksheet.read_text(), 4)[1] == "15"


def test_another_maximum_is_converted_only_when_that_is_wanted(course, say):
    mark_by_hand(course, 1.0)
    path = write(course, moodle([ANNA, BOB, EVE], most="100.00"))
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    assert (status, output) == (1, "")
    assert wrong == (
        f"Nothing was filled in: {ASSIGNMENT} has 15 points, and 100 in sheet.csv: set 15 on the platform and "
        "export again, or convert the points with --scale.\n"
    )
    assert path.read_text() == moodle([ANNA, BOB, EVE], most="100.00")
    assert say("grades", ASSIGNMENT, "--moodle", "sheet.csv", "--scale")[0] == 0
    assert column(path.read_text(), 4) == ["Grade", "73.33", "0", "73.33"]


def test_500_students_with_odd_names(tmp_path):
    drawn = random.Random(4)
    parts = ["Müller", "O'Hara", "van der Berg", "=1+1", "علي", "שרה", 'The "Kid"', "Ng, Jr.", "Łukasz", "李雷", "-", "@x"]
    people = [
        (1000 + at, f"{drawn.choice(parts)} {drawn.choice(parts)}", f"s{at}@example.org") for at in range(500)
    ]
    students = [KnownStudent(f"s{at}", mail=f"S{at}@example.org") for at in range(500)]
    marks = {f"s{at}": PlatformMark(at % 31 / 2) for at in range(500)}
    path = tmp_path / "sheet.csv"
    drawn.shuffle(people)
    for header, most in ((ENGLISH, "15.00"), (GERMAN, "15,00")):
        path.write_text(moodle(people, header, most))
        sheet = read_moodle(CsvFile(path))
        report = fill_grades(sheet, marks, 15.0, students)
        assert (report.filled, report.problems, report.replaced) == (500, [], [])
        text = sheet.file.to_bytes().decode()
        assert others(text, 4) == others(path.read_text(), 4)
        expected = [f"{(number - 1000) % 31 / 2:g}" for number, _, _ in (by_mail(person) for person in people)]
        mark = "," if header == GERMAN else "."
        assert column(text, 4)[1:] == [points.replace(".", mark) for points in expected]
    rows = [(name, str(number), "", mail) for number, name, mail in people]
    path.write_text(canvas(rows))
    sheet = read_canvas(CsvFile(path), titles=["01_class"])
    assert fill_grades(sheet, marks, 15.0, students).problems == []
    assert others(sheet.file.to_bytes().decode(), 5) == others(path.read_text(), 5)


def by_mail(person: tuple[int, str, str]) -> tuple[int, str, str]:
    number = int(person[2].removeprefix("s").partition("@")[0])
    return (1000 + number, person[1], person[2])


HALF = "expected a number that shows whether 13.5 has a point or a comma, saw none: give --decimal . or --decimal ,"


def test_a_decimal_mark_that_the_file_doesn_t_show_is_asked_for(course, say):
    mark_by_hand(course, 3.5)
    rows = [(*CANVAS[:5], "01_class (4711)"), ("P", "", "", "", "", "15"), ("x", "7", "", "anna", "A", "")]
    path = write(course, php_csv(rows, ";"))
    assert say("grades", ASSIGNMENT, "--canvas", "sheet.csv") == (1, "", f"Nothing was filled in: sheet.csv: {HALF}.\n")
    assert say("grades", ASSIGNMENT, "--canvas", "sheet.csv", "--decimal", ",")[0] == 1
    assert column(path.read_text(), 5, ";")[2] == "13,5"


MOODLE_WAY = "download it with View all submissions, Grading worksheet"


@pytest.mark.parametrize(
    ("text", "options", "sentence"),
    [
        (
            "Name,Grade,Max\nAnna,,15\n",
            (),
            f"expected a worksheet with `Participant 123` or the like in its first column, saw 'Anna': {MOODLE_WAY}",
        ),
        (
            "Name,Grade,Max\n",
            (),
            f"expected a worksheet with `Participant 123` or the like in its first column, saw no rows: {MOODLE_WAY}",
        ),
        (
            "Id,Name,Grade\nUser 1,Anna,\n",
            (),
            "expected one column of grades with the maximum after it, saw none: name it with --column",
        ),
        (
            "Id,Name,A,Max,B,Max\nUser 1,Anna,,15,,20\n",
            (),
            "expected one column of grades with the maximum after it, saw 'A' or 'B': name it with --column",
        ),
        (
            moodle([ANNA]),
            ("--column", "Note"),
            "expected one column for grades titled 'Note', saw 'Email address', 'Status', 'Grade', "
            "'Maximum Grade', 'Grade can be changed', 'Last modified (submission)', 'Last modified (grade)'",
        ),
        (
            moodle([ANNA]),
            ("--column", "Status"),
            "expected one maximum in the column 'Grade', after the grades, saw '': "
            "an assignment that gives points has it",
        ),
    ],
)
def test_a_worksheet_that_can_t_be_filled_is_named_with_what_was_expected(course, say, text, options, sentence):
    write(course, text)
    answer = say("grades", ASSIGNMENT, "--moodle", "sheet.csv", *options)
    assert answer == (1, "", f"Nothing was filled in: sheet.csv: {sentence}.\n")


@pytest.mark.parametrize(
    ("text", "options", "sentence"),
    [
        (
            moodle([ANNA]),
            (),
            "expected the columns Student, ID and Section, saw Identifier, Full name, Email address, Status, Grade, "
            "Maximum Grade: export the gradebook of Canvas",
        ),
        (
            canvas([], [*CANVAS[:5], "Nodes (1)", "Essay (2)", *CANVAS[7:]]),
            (),
            "expected one column titled '01_class', saw 'Nodes (1)', 'Essay (2)': name it with --column",
        ),
        (
            canvas([], [*CANVAS[:5], "01_class (1)", "01_class (2)", *CANVAS[7:]]),
            ("--column", "01_class"),
            "expected one column for grades titled '01_class', saw 2",
        ),
        (
            canvas([], most="(read only)"),
            (),
            "expected the possible points of '01_class (4711)' above the students, saw '(read only)': "
            "export the gradebook of Canvas again",
        ),
        (
            php_csv([CANVAS]),
            (),
            "expected the possible points of '01_class (4711)' above the students, saw no such row: "
            "export the gradebook of Canvas again",
        ),
    ],
)
def test_an_export_that_can_t_be_filled_is_named_with_what_was_expected(course, say, text, options, sentence):
    write(course, text)
    answer = say("grades", ASSIGNMENT, "--canvas", "sheet.csv", *options)
    assert answer == (1, "", f"Nothing was filled in: sheet.csv: {sentence}.\n")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("nodes", "--moodle", "sheet.csv"), f"Nothing was filled in: there is no assignment nodes: there are {ASSIGNMENT}.\n"),
        ((ASSIGNMENT, "--moodle", "no.csv"), "Stopped: no.csv can't be read or written (No such file or directory).\n"),
    ],
)
def test_what_is_not_there_is_named(course, say, arguments, sentence):
    write(course, moodle([ANNA]))
    assert say("grades", *arguments) == (1, "", sentence)


def test_without_marks_nothing_is_filled_in(course, say):
    write(course, moodle([ANNA]))
    with Gradebook(course.database, course.name) as book:
        for student in ("anna", "bob", "eve"):
            book.remove_submission(ASSIGNMENT, student)
    reported = f"the gradebook has no marks of {ASSIGNMENT}: run `python -m grader mark ASSIGNMENT` first"
    answer = say("grades", ASSIGNMENT, "--moodle", "sheet.csv")
    assert answer == (1, "", f"Nothing was filled in: {reported}.\n")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--moodle", "x"), "expected the name of an assignment, or --total"),
        ((ASSIGNMENT, "--total", "--moodle", "x"), "expected the name of an assignment, or --total"),
        ((ASSIGNMENT,), "expected --moodle FILE, --canvas FILE or --feedback-zip FILE"),
        (("--total", "--feedback-zip", "x"), "expected the name of an assignment with --feedback-zip"),
        ((ASSIGNMENT, "--moodle", "x", "--canvas", "y"), "argument --canvas: not allowed with argument --moodle"),
    ],
)
def test_options_that_don_t_go_together(course, say, capsys, arguments, sentence):
    with pytest.raises(SystemExit, match="2"):
        say("grades", *arguments)
    assert capsys.readouterr().err.endswith(f"error: {sentence}\n")
