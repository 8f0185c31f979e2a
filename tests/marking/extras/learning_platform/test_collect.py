"""`python -m grader collect`: submissions out of a platform's archive; and the feedback that goes back."""
import io
import json
import stat
import struct
import zipfile
from datetime import datetime

import nbformat
import pytest

from grader.marking.extras.learning_platform import archive as archives
from grader.marking.extras.learning_platform import uploads
from tests.marking.classroom import ASSIGNMENT, released
from tests.marking.extras.learning_platform.exports import archive, canvas, moodle, packed

NB = "nodes.ipynb"


@pytest.fixture
def notebook(course) -> bytes:
    return nbformat.writes(released(course)).encode()


@pytest.fixture
def collect(course, say):
    """Collects an archive of these files."""
    return lambda files, *options: say("collect", str(archive(course.root / "all.zip", files)), *options)


def content(course, student: str) -> dict[str, bytes]:
    folder = course.submitted(student, ASSIGNMENT)
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def counts(new: int = 0, replaced: int = 0, unchanged: int = 0) -> str:
    total = new + replaced + unchanged
    return f"{ASSIGNMENT}: {total} submissions collected: {new} new, {replaced} replaced, {unchanged} unchanged.\n"


def test_moodle_s_archive_is_sorted_in(course, collect, notebook):
    top = "ROS-Nodes-123/"
    files = {
        f"{top}Anna Meier_501_assignsubmission_file_/{NB}": notebook,
        f"{top}van_der_Berg Jan_502_assignsubmission_file_/my_{NB}": notebook,
        f"{top}van_der_Berg Jan_502_assignsubmission_file_/ws/src/a/setup.py": b"x",
        f"{top}علي حسن_503_assignsubmission_file_{NB}": notebook,
        f"{top}Anna Meier_501_assignsubmission_onlinetext_/onlinetext.html": b"hi",
        f"{top}__MACOSX/._Anna Meier_501_assignsubmission_file_": b"junk",
        f"{top}.DS_Store": b"junk",
    }
    status, output, wrong = collect(files)
    text = f"  {top}Anna Meier_501_assignsubmission_onlinetext_/onlinetext.html: names no student.\n"
    assert (status, output, wrong) == (0, counts(new=2, replaced=1) + text, "")
    assert content(course, "anna") == {NB: notebook}
    assert content(course, "van_der_Berg Jan") == {f"my_{NB}": notebook, "ws/src/a/setup.py": b"x"}
    assert content(course, "علي حسن") == {NB: notebook}
    assert collect(files)[1] == counts(unchanged=3) + text


def test_a_worksheet_says_who_the_participants_are(course, collect, notebook):
    people = [(501, "Anna Meier", "am@example.org"), (502, "Anna Meier", "bob"), (503, "New", "new@example.org")]
    (course.root / "sheet.csv").write_text(moodle(people))
    files = {f"Anna Meier_{number}_assignsubmission_file_/{NB}": notebook for number in (501, 502)}
    files[f"New_503_assignsubmission_file_/{NB}"] = notebook
    status, output, wrong = collect(files)
    several = "give the platform's grading sheet with --moodle or --canvas"
    assert (status, output) == (1, counts(new=1))
    assert wrong.splitlines() == [
        f"  Anna Meier ({number}): may be anna, and is not collected: {several}." for number in (501, 502)
    ]
    zone = f"{datetime.now().astimezone():%Z}"
    times = f"  Their times are those of sheet.csv, read as local time ({zone}).\n"
    assert collect(files, "--moodle", "sheet.csv")[:2] == (0, counts(replaced=2, unchanged=1) + times)
    files = [content(course, student) for student in ("anna", "bob", "New")]
    assert [(sorted(each), each[NB]) for each in files] == [([NB, "timestamp.txt"], notebook)] * 3


def test_two_new_people_of_one_name_are_listed(course, collect, notebook):
    files = {f"Jo Li_{number}_assignsubmission_file_/{NB}": notebook for number in (1, 2)}
    files[f"Eva_3_assignsubmission_file_/{NB}"] = notebook
    status, output, wrong = collect(files)
    several = "give the platform's grading sheet with --moodle or --canvas"
    assert (status, output) == (1, counts(new=1))
    assert wrong.splitlines() == [
        f"  Jo Li ({number}): there are several Jo Li, and is not collected: {several}." for number in (1, 2)
    ]


def test_canvas_s_archive_the_newest_upload_counts(course, collect, notebook):
    old = notebook.replace(b"Counter", b"Kounter")
    files = {
        "meieranna_1001_90_nodes.ipynb": old,
        "meieranna_1001_95_nodes-1.ipynb": notebook,
        "müllerjürgen_LATE_1002_91_nodes-2.ipynb": notebook,
        "van_der_berg_1003_92_nodes.ipynb": notebook,
        "anon_7Ab9c_LATE_93_nodes.ipynb": notebook,
        "index.html": b"x",
    }
    status, output, wrong = collect(files)
    assert (status, wrong) == (0, "")
    assert output == counts(new=3, replaced=1) + (
        "  meieranna_1001_90_nodes.ipynb: was uploaded again, meieranna_1001_95_nodes-1.ipynb counts.\n"
        "  index.html: names no student.\n"
        "  1002: handed in late, as the platform says.\n"
        "  anon_7Ab9c: handed in late, as the platform says.\n"
    )
    for student in ("anna", "1002", "1003", "anon_7Ab9c"):
        assert content(course, student) == {NB: notebook}
    again = collect({"meieranna_1001_90_nodes.ipynb": old})
    older = "  anna: this upload is older than the one that was collected before.\n"
    assert again == (0, counts() + older, "")
    assert content(course, "anna") == {NB: notebook}


def test_canvas_s_numbers_are_those_of_the_export(course, collect, notebook):
    (course.root / "e.csv").write_text(canvas([("Meier, A.", "1001", "S1", "anna"), ("X", "1002", "S2", "x@y.org")]))
    files = {"meiera_1001_90_nodes.ipynb": notebook, "x_1002_91_nodes.ipynb": notebook}
    assert collect(files, "--canvas", "e.csv") == (0, counts(new=1, replaced=1), "")
    assert content(course, "x@y.org") == {NB: notebook}
    assert collect(files)[:2] == (0, counts(unchanged=2))  # their numbers are known now


def test_a_new_number_that_is_another_student_s_id_is_not_collected(course, collect, notebook):
    course.submitted("1001", ASSIGNMENT).mkdir(parents=True)
    status, output, wrong = collect({"x_1001_90_nodes.ipynb": notebook})
    assert (status, output) == (1, counts())
    why = "would be 1001, which is another student, and is not collected"
    assert wrong == f"  x (1001): {why}: give the platform's grading sheet with --moodle or --canvas.\n"


def test_files_packed_by_hand_are_named_by_student(course, collect, notebook):
    old = notebook.replace(b"Counter", b"Kounter")
    files = {
        "in/anna-lena_nodes.ipynb": old,
        "in/anna-lena_nodes-1.ipynb": notebook,
        "in/o'hara_nodes.ipynb": notebook,
        "in/jo_van_LATE_nodes.ipynb": notebook,
        "in/__MACOSX/._anna-lena_nodes.ipynb": b"junk",
        "in/notes.txt": b"?",
    }
    status, output, wrong = collect(files)
    assert (status, wrong) == (0, "")
    assert output == counts(new=3) + (
        "  in/anna-lena_nodes.ipynb: was uploaded again, in/anna-lena_nodes-1.ipynb counts.\n"
        "  in/notes.txt: names no student.\n"
        "  jo_van: handed in late, as the platform says.\n"
    )
    for student in ("anna-lena", "o'hara", "jo_van"):
        assert content(course, student) == {NB: notebook}


def test_a_zip_in_the_archive_is_unpacked_once(course, collect, notebook):
    inner = {
        f"work/{NB}": notebook,
        "work/ws/src/a.py": b"1",
        "work/../../../evil": b"x",
        "work/more.zip": packed({"a": b""}),
        "__MACOSX/work/._a": b"",
    }
    name = "Anna Meier_501_assignsubmission_file_"
    files = {f"{name}/work.zip": packed(inner), f"{name}/{NB}": notebook, f"{name}/bad.ZIP": b"no"}
    status, output, wrong = collect(files, "--assignment", ASSIGNMENT)
    assert (status, wrong) == (0, "")
    assert output.splitlines()[1:] == [
        f"  {name}/work.zip: work/../../../evil: has a path that leads out of the archive.",
        f"  {name}/work.zip: work/more.zip: is a ZIP in a ZIP in a ZIP.",
        f"  {name}/{NB}: has the name of another file, {name}/work.zip: work/{NB} counts.",
        f"  {name}/bad.ZIP: is not a ZIP (File is not a zip file).",
    ]
    assert content(course, "anna") == {NB: notebook, "ws/src/a.py": b"1"}


def test_nothing_leaves_the_folder_and_no_link_is_made(course, collect, notebook):
    link = zipfile.ZipInfo(f"anna_1_2_{NB}")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    evil = f"Eve_7_assignsubmission_file_/../../../../{NB}"
    path = course.root / "all.zip"
    with zipfile.ZipFile(path, "w") as made:
        made.writestr(link, "/etc/passwd")
        for name in (evil, f"/abs/eve_1_3_{NB}", f"C:\\eve_1_4_{NB}", f"bob_1_5_{NB}"):
            made.writestr(name, notebook)
    before = sorted(course.root.rglob("*"))
    status, output, wrong = collect_path(course, path)
    assert (status, wrong) == (0, "")
    assert output.splitlines()[1:] == [
        f"  anna_1_2_{NB}: is a link.",
        f"  {evil}: has a path that leads out of the archive.",
        f"  /abs/eve_1_3_{NB}: has a path that leads out of the archive.",
        f"  C:/eve_1_4_{NB}: has a path that leads out of the archive.",
    ]
    new = set(course.root.rglob("*")) - set(before)
    assert {path.relative_to(course.root).as_posix() for path in new} == {"class/platform", f"class/platform/{ASSIGNMENT}.json"}


def collect_path(course, path, *options):
    """Run the command, and return status, output and errors."""
    import contextlib

    from grader.__main__ import main

    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main(["collect", str(path), *options])
    return status, out.getvalue(), err.getvalue()


def test_sizes_are_limited_whatever_the_archive_says(course, notebook, monkeypatch, tmp_path):
    monkeypatch.setattr(archives, "MAX_FILE_BYTES", 2_000_000)
    bomb = packed({f"anna_1_2_{NB}": b"0" * 3_000_000, f"bob_2_3_{NB}": notebook})
    lying = bomb.replace(struct.pack("<I", 3_000_000), struct.pack("<I", 1_000))
    for data, sentence in ((bomb, "has more than 2 MB"), (lying, "is damaged (Bad CRC-32 for file")):
        (tmp_path / "a.zip").write_bytes(data)
        _, output, wrong = collect_path(course, tmp_path / "a.zip")
        assert sentence in output + wrong
        assert content(course, "bob") == {NB: notebook}


def test_an_upload_has_few_files_of_limited_size(course, collect, notebook, monkeypatch):
    name = "Anna Meier_501_assignsubmission_file_"
    monkeypatch.setattr(uploads, "MAX_FILES", 2)
    many = {f"{name}/{at}.txt": b"x" for at in range(2)} | {f"{name}/{NB}": notebook}
    whose = "  anna: the upload of Anna Meier (501)"
    assert collect(many) == (1, counts(), f"{whose} has 3 files, and at most 2 are taken.\n")
    monkeypatch.setattr(uploads, "MAX_BYTES", 1_000_000)
    large = {f"{name}/a": b"x" * 1_000_001, f"{name}/{NB}": notebook}
    assert collect(large) == (1, counts(), f"{whose} has more than 1 MB.\n")
    long = {f"{name}/{'a' * 201}": b"", f"{name}/{NB}": notebook}
    assert collect(long) == (1, counts(), f"{whose} has a file that can't be written: {'a' * 60!r}.\n")
    both = {f"{name}/a": b"", f"{name}/a/{NB}": notebook}
    assert collect(both) == (1, counts(), f"{whose} has a file that can't be written: 'a'.\n")


def test_an_encrypted_file_and_a_damaged_one_are_listed(course, notebook, tmp_path):
    data = bytearray(packed({f"anna_1_2_{NB}": notebook}))
    central = data.rindex(b"PK\x01\x02")
    data[central + 8] |= 1
    (tmp_path / "a.zip").write_bytes(data)
    status, output, wrong = collect_path(course, tmp_path / "a.zip")
    assert (status, output) == (1, "")
    assert wrong == (
        f"Nothing was collected: no file in {tmp_path / 'a.zip'} can be used: anna_1_2_nodes.ipynb: is encrypted.\n"
    )


@pytest.mark.parametrize(
    ("files", "options", "sentence"),
    [
        ({"a.txt": b""}, (), "expected the notebooks of one assignment in ALL, saw none: give --assignment NAME"),
        (
            {"a.txt": b""},
            ("--assignment", ASSIGNMENT),
            "no file in ALL can be used: a.txt: names no student",
        ),
        ({NB: b""}, ("--assignment", "x"), f"there is no assignment x: there are {ASSIGNMENT}"),
        ({}, ("--assignment", ASSIGNMENT), "no file in ALL can be used: it is empty"),
    ],
)
def test_an_archive_without_submissions(course, collect, files, options, sentence):
    where = str(course.root / "all.zip")
    assert collect(files, *options) == (1, "", f"Nothing was collected: {sentence.replace('ALL', where)}.\n")


def test_what_is_no_archive_is_named(course, say):
    (course.root / "a.zip").write_bytes(b"no")
    assert say("collect", "a.zip") == (
        *(1, ""),
        "Nothing was collected: expected a ZIP from the platform, saw a.zip (File is not a zip file).\n",
    )
    no = "Stopped: no.zip can't be read or written (No such file or directory).\n"
    assert say("collect", "no.zip") == (1, "", no)


def test_a_damaged_record_is_named(course, collect, notebook):
    record = course.platform_files() / f"{ASSIGNMENT}.json"
    record.parent.mkdir()
    record.write_text("[]")
    said = "'list' object has no attribute 'items'"
    advice = "delete it, and collect the archive again"
    assert collect({f"a_1_2_{NB}": notebook}) == (
        *(1, ""),
        f"Nothing was collected: {record} can't be read ({said}): {advice}.\n",
    )


def test_an_archive_with_too_many_entries_is_refused(course, collect, notebook, monkeypatch):
    monkeypatch.setattr(archives, "MAX_ENTRIES", 1)
    status, output, wrong = collect({f"a_1_2_{NB}": notebook, "b": b""})
    saw = f"expected a ZIP from the platform, saw {course.root / 'all.zip'} (has 2 entries, and at most 1 are read)"
    assert (status, output, wrong) == (1, "", f"Nothing was collected: {saw}.\n")


def test_names_that_are_no_folders_are_made_harmless(course, collect, notebook):
    files = {f"<img src=x>_5_assignsubmission_file_/{NB}": notebook, f"=1+1_6_assignsubmission_file_/{NB}": notebook}
    assert collect(files)[:2] == (0, counts(new=2))
    assert content(course, "_img src_x_") == content(course, "_1_1") == {NB: notebook}


def write_pages(course, *students: str) -> None:
    for student in students:
        page = course.feedback(student, ASSIGNMENT) / "nodes.html"
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(f"<html>{student}</html>")


def test_feedback_goes_back_under_the_names_of_the_archive(course, collect, say, notebook):
    collect({f"top/van_der Anna Meier_501_assignsubmission_file_/{NB}": notebook})
    collect({"bob_LATE_1002_91_nodes-2.ipynb": notebook})
    write_pages(course, "anna", "bob", "van_der Anna Meier")
    status, output, wrong = say("grades", ASSIGNMENT, "--feedback-zip", "back.zip")
    assert (status, output) == (1, "back.zip: the pages of 2 students.\n")
    assert wrong.splitlines() == [
        "  anna: was not collected from the platform, and is not in back.zip.",
        "  eve: was not collected from the platform, and is not in back.zip.",
    ]
    with zipfile.ZipFile("back.zip") as made:
        assert {name: made.read(name) for name in made.namelist()} == {
            "bob_LATE_1002_91_feedback.html": b"<html>bob</html>",
            "van der Anna Meier_501_assignsubmission_file/feedback.html": b"<html>van_der Anna Meier</html>",
        }


def test_a_worksheet_gives_the_names_of_feedback_too(course, say):
    write_pages(course, "anna", "bob")
    (course.feedback("bob", ASSIGNMENT) / "more.html").write_text("more")
    sheet = moodle([(501, "Anna_Meier", "anna"), (502, "B", "bob"), (503, "E", "eve")])
    (course.root / "s.csv").write_text(sheet)
    status, output, wrong = say("grades", ASSIGNMENT, "--moodle", "s.csv", "--feedback-zip", "back.zip")
    assert (status, output.splitlines()[1]) == (1, "back.zip: the pages of 2 students.")
    assert wrong == f"  eve: has no page, and is not in back.zip: mark {ASSIGNMENT} first.\n"
    assert sorted(zipfile.ZipFile("back.zip").namelist()) == [
        "Anna Meier_501_assignsubmission_file/feedback.html",
        "B_502_assignsubmission_file/more.html",
        "B_502_assignsubmission_file/nodes.html",
    ]


def test_without_the_platform_s_names_there_is_no_feedback_zip(course, say):
    assert say("grades", ASSIGNMENT, "--feedback-zip", "back.zip") == (
        *(1, ""),
        f"Nothing was filled in: it isn't known what the platform calls the students of {ASSIGNMENT}: "
        "collect its archive, or give its worksheet with --moodle.\n",
    )


def test_a_round_trip_with_500_students(course, collect, notebook):
    files = {f"Jürgen, der {at}. (=1+1) علي_{at}_assignsubmission_file_/{NB}": notebook for at in range(1000, 1500)}
    assert collect(files)[:2] == (0, counts(new=500))
    known = json.loads((course.platform_files() / f"{ASSIGNMENT}.json").read_text())
    assert {each["number"] for each in known.values()} == {str(at) for at in range(1000, 1500)}
