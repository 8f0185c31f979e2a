"""Pairs that derive from each other are found among independent ones, and the pages accuse no one."""
import ast
import re
import shutil
import zipfile
from pathlib import Path

import pytest

from grader.__main__ import main
from grader.marking.extras.likeness.equal_runs import EqualRuns, equal_runs
from grader.marking.extras.likeness.likeness_pages import side_by_side
from grader.marking.extras.likeness.pairs import ClassLikeness, LikePair, most_alike
from grader.marking.extras.likeness.student_texts import StudentText, WrittenPart, read_texts
from grader.marking.extras.likeness.syntax_grams import grams, overlap, python_of
from grader.marking.submission.assignment_release import load_release
from tests.marking.extras.likeness.generated_class import ASSIGNMENT, EXERCISES, designs, hand_in
from tests.marking.tiny import ROOT

NODE = """
class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.count += 1
        if self.count > 10:
            self.count = 0
"""
RENAMED = """
class Adder(Node):  # another comment
    def go(me):
        me.n += 2
        if me.n > 99:
            me.n = 1

    def __init__(me):
        '''Begin.'''
        super().__init__("adder")
        me.n = 7
        me.create_timer(1.5, me.go)
"""
OTHER = "def rest(all):\n    return [x for x in all if x % 2] or {a: b for a, b in zip(all, all)}\n"


def test_names_numbers_comments_and_the_order_of_methods_make_no_difference():
    assert grams([NODE]) == grams([RENAMED])
    assert overlap(grams([NODE]), grams([RENAMED])) == 1.0
    assert overlap(grams([NODE]), grams([OTHER])) < 0.2


def test_lines_of_ipython_and_files_that_a_cell_writes_are_understood():
    assert python_of("%pip install x\nif a:\n    !ls\n") == "pass\nif a:\n    pass\n"
    assert grams([f"%%writefile a.py\n{NODE}"]) == grams([NODE])
    assert grams(["this is no Python"]) == frozenset()
    assert overlap(frozenset(), grams([NODE])) == 0.0


def found_pairs(folder: Path, students: int, pairs: int) -> tuple[ClassLikeness, set[frozenset[str]]]:
    planted = hand_in(folder, students, pairs)
    submissions = {path.name: path / ASSIGNMENT for path in sorted(folder.iterdir())}
    texts, problems = read_texts(submissions, load_release(ROOT / "exercises" / ASSIGNMENT))
    assert problems == {}
    return most_alike(texts, 20), planted


def names(pair: LikePair) -> frozenset[str]:
    return frozenset({pair.first.student, pair.second.student})


@pytest.mark.parametrize(
    ("students", "pairs"), [(30, 3), pytest.param(300, 10, marks=pytest.mark.soak)]
)
def test_planted_pairs_are_the_first_and_no_other_is_like_them(tmp_path, students, pairs):
    found, planted = found_pairs(tmp_path, students, pairs)
    assert {names(pair) for pair in found.pairs[:pairs]} == planted
    least, next_one = found.pairs[pairs - 1].likeness, found.pairs[pairs].likeness
    assert least > 0.85
    assert next_one < least - 0.1
    assert (found.total, len(found.pairs)) == (students * (students - 1) // 2, 20)
    assert found.pairs[0].as_like >= 1
    assert found.pairs[pairs - 1].as_like == pairs


def test_each_exercise_has_several_designs():
    assert {name: len(designs(name)) > 3 for name in EXERCISES} == dict.fromkeys(EXERCISES, True)


def text(student: str, source: str) -> StudentText:
    return StudentText(student, (WrittenPart("topics: square", source),), grams([source]))


def test_what_is_too_short_is_not_compared():
    found = most_alike([text("ann", "x = 1"), text("bob", "x = 1")], 20)
    assert (found.pairs, found.short, found.total) == ([], ["ann", "bob"], 0)


def test_texts_stand_side_by_side_with_equal_lines_beside_each_other():
    pair = LikePair(text("ann", "a = 1\nb = 2\nc = 3"), text("bob", "a  = 1\nc = 3"), 0.5, 1)
    assert side_by_side(pair) == [
        ("# topics: square", "# topics: square", True),
        ("a = 1", "a  = 1", True),
        ("b = 2", "", False),
        ("c = 3", "c = 3", True),
    ]


@pytest.fixture
def course(tmp_path, monkeypatch) -> Path:
    """A class of twelve students in a course's folder, of whom one derived a text; the test runs there."""
    shutil.copy(ROOT / "nbgrader_config.py", tmp_path)
    shutil.copytree(ROOT / "exercises" / ASSIGNMENT, tmp_path / "exercises" / ASSIGNMENT)
    hand_in(tmp_path / "class" / "submitted", 12, 1)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_command_writes_pages_and_a_zip_that_accuse_no_one(course, capsys):
    broken = course / "class" / "submitted" / "zoe" / ASSIGNMENT
    broken.mkdir(parents=True)
    (broken / "topics.ipynb").write_text("<script>alert(1)</script>")
    assert main(["likeness", ASSIGNMENT]) == 0
    printed, errors = capsys.readouterr()
    place = course / "class" / "likeness" / ASSIGNMENT
    assert printed.splitlines()[-2] == f"66 pairs were compared: {place / 'index.html'}"
    assert printed.splitlines()[-1] == (
        "Likeness is no proof of anything: look at both texts, and talk with both students."
    )
    assert printed.splitlines()[0].endswith("and student011 (1 of 66 pairs)")
    assert errors.startswith("zoe was not compared: ")
    overview = (place / "index.html").read_text()
    assert "66 pairs were compared" in overview
    for page in place.glob("*.html"):
        shown = page.read_text().lower()
        assert not [word for word in ("cheat", "plagiar", "stole", "suspect", "guilty") if word in shown]
        assert "script>" not in shown
        assert page.stat().st_mode & 0o077 == 0
    with zipfile.ZipFile(place / "texts.zip") as archive:
        students = [f"student{n:03}/student{n:03}.py" for n in range(12)]
        assert archive.namelist() == [*students, "release/release.py", "info.csv"]
        rows = archive.read("info.csv").decode().splitlines()
        assert rows[:2] == ["filename,full_name,ignored", "student000/student000.py,student000,false"]
        assert rows[-1] == "release/release.py,the release,true"
        source = archive.read("student000/student000.py").decode()
        for name in [*students, "release/release.py"]:
            ast.parse(archive.read(name), name)
    given = "from grader.exercises import topics"
    assert given in (ROOT / "exercises" / ASSIGNMENT / "topics.ipynb").read_text()
    assert given not in source
    assert "# topics: square" in source


def test_an_earlier_year_is_compared_with_this_one_and_not_with_itself(course, tmp_path, capsys):
    old = tmp_path / "2025" / "class" / "submitted"
    shutil.copytree(course / "class" / "submitted", old)
    assert main(["likeness", ASSIGNMENT, "--earlier", str(old), "--pairs", "12"]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("100%  student000 and student000 (2025)")
    assert f"{12 * 11 // 2 + 12 * 12} pairs were compared" in printed[-2]


def test_missing_submissions_are_named_in_one_sentence(course, tmp_path, capsys):
    assert main(["likeness", "77_none"]) == 1
    known = ", ".join(sorted(path.name for path in (course / "exercises").glob("[01]*")))
    assert capsys.readouterr().err == (
        f"Not compared: {course}/exercises has no assignment 77_none: there are {known}.\n"
    )
    assert main(["likeness", ASSIGNMENT, "--earlier", str(tmp_path / "nowhere")]) == 1
    assert capsys.readouterr().err == (
        f"Not compared: expected submissions in {tmp_path}/nowhere/STUDENT/{ASSIGNMENT}, saw none.\n"
    )


def test_equal_runs_are_counted_in_each_exercise_and_rare_ones_differ_from_usual_ones():
    digests = {f"s{n:02}": {"usual": ("a",), "rare": (f"own {n}",)} for n in range(20)}
    digests["s03"]["rare"] = digests["s07"]["rare"] = ("same", "same again")
    digests["s19"] = {"usual": ("b",)}
    usual, rare = equal_runs(digests, given={})
    assert (usual.exercise, usual.pairs, usual.total, usual.rare) == ("usual", 171, 190, False)
    assert (rare.groups, rare.pairs, rare.total, rare.rare) == ((("s03", "s07"),), 1, 171, True)
    assert (rare.has("s07", "s03"), rare.has("s03", "s04")) == (True, False)
    assert EqualRuns("alone", (), 0, 0).share == 0.0


def test_who_wrote_nothing_ran_equally_with_no_one():
    digests = {"ann": {"square": ("starter",)}, "bob": {"square": ("starter",)}, "eve": {"square": ("own",)}}
    (square,) = equal_runs(digests, given={"square": ("starter",)})
    assert (square.groups, square.pairs, square.total) == ((), 0, 0)


def test_the_pages_say_whose_nodes_ran_equally_and_how_usual_that_is(course, capsys):
    for student in sorted((course / "class" / "submitted").iterdir())[3:]:
        shutil.rmtree(student)
    shutil.copytree(course / "class" / "submitted" / "student001", course / "class" / "submitted" / "zoe")
    for empty in ("ann", "bob"):  # who hand in what they were given
        shutil.copytree(course / "exercises" / ASSIGNMENT, course / "class/submitted" / empty / ASSIGNMENT)
    assert main(["likeness", ASSIGNMENT, "--runs"]) == 0
    place = course / "class" / "likeness" / ASSIGNMENT
    found = re.findall(r"<td>(\w+)</td><td>(\d+) of (\d+)</td>", (place / "index.html").read_text())
    rows = {name: (int(pairs), int(total)) for name, pairs, total in found}
    assert rows["temperature"] == (1, 6)  # of four students: ann and bob left it empty
    assert "ann, bob" not in (place / "index.html").read_text().partition("Whose nodes")[2]
    pair = (place / "pair-01.html").read_text()
    assert "<h1>student001 and zoe</h1>" in pair
    words = "temperature: their nodes ran equally, to the millisecond, as those of 1 of 6 pairs did."
    assert words in pair
