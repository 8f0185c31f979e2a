import csv
import io
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from grader.diagnosis.fault import NOT_STARTED
from grader.marking.command.summary import CommonMistake, Concern, summarize
from grader.marking.command.summary_page import as_page, page_links
from grader.marking.command.summary_text import as_csv, as_text
from grader.marking.gradebook.student_standings import Standing
from grader.marking.result import CellResult, NotebookResult, Result
from tests.marking.classroom import verdict

WORTH = {("nodes", "test_counter"): 4.0, ("nodes", "test_line"): 6.0, ("nodes", "essay"): 5.0}
ALARM = "Traceback (most recent call last):\n  File ...\nKeyError: 'odom'\n"


def counted(credit):
    return CellResult("test_counter", "counter", 4 * credit, 4.0, [verdict("counter", 4, credit)])


def lined(credit, **changes):
    return CellResult("test_line", "line", 6 * credit, 6.0, [verdict("line", 6, credit)], **changes)


def student(name, *cells, seconds=0.5, **changes):
    note = NotebookResult("nodes", {}, list(cells))
    timings = {"total": seconds, "memory": 120.0, "nodes/test_line": seconds / 2, "nodes/test_counter": 0.25}
    base = {"verdict": "marked", "notebooks": [note] if cells else [], "timings": timings}
    return Result(name, "01_class", "00", **{**base, **changes})


@pytest.fixture
def results():
    broken = [{**verdict("line", 6, 0), "status": "broken", "alarm": ALARM}]
    found = [
        student("anna", counted(1), lined(0.5)),
        student("bob", counted(0.25), lined(0.5), seconds=2.0, flags=["The test cell `x` was edited."]),
        student("carl", counted(1), replace(lined(0), needs_look=True, verdicts=broken)),
        student("dora", counted(1), lined(0.25), verdict="repaired", repairs=["It was repaired."]),
        student("eve", verdict="refused", reason="`nodes.ipynb` is empty."),
    ]
    return {result.student: result for result in found}


def test_the_text_says_points_mistakes_what_to_look_at_and_times(results):
    assert as_text(summarize("01_class", WORTH, results)) == (
        "student  counter  line  essay  total   verdict  flags\n"
        "of             4     6      5     15\n"
        "anna           4     3      -      7    marked\n"
        "bob            1     3      -      4    marked      1\n"
        "carl           4     0      -      4    marked\n"
        "dora           4   1.5      -    5.5  repaired\n"
        "eve            -     -      -      0   refused\n"
        "\n"
        "Common mistakes\n"
        "  3 of 5  line: It keeps time.\n"
        "          Saw: 4 lines in 8 s\n"
        "          Hint: Look at the timer.\n"
        "  1 of 5  counter: It keeps time.\n"
        "          Saw: 2 lines in 8 s\n"
        "          Hint: Look at the timer.\n"
        "\n"
        "Needs your attention\n"
        "  nodes/essay: 4 answers have to be marked by hand, in the formgrader\n"
        "  bob: The test cell `x` was edited.\n"
        "  carl: a check of nodes/test_line is broken (KeyError: 'odom'): set the points by hand\n"
        "  eve: refused: `nodes.ipynb` is empty.\n"
        "\n"
        "A submission took 0.5 s (median), 2.0 s at most.\n"
        "Slowest cells: nodes/test_line 0.25 s, nodes/test_counter 0.25 s"
    )


def test_only_so_many_mistakes_are_shown(results):
    text = as_text(summarize("01_class", WORTH, results), mistakes=1)
    assert "3 of 5" in text
    assert "1 of 5" not in text


def test_mistakes_are_counted_by_student_and_named_by_what_most_of_them_did():
    hints = ["Look at the timer.", "Is it a typo?", "Look at the timer."]
    results = {}
    for number, hint in enumerate(hints):
        missed = verdict("line", 6, 0, saw=f"{number}.5 lines in 1e-{number} s", hint=hint)
        cell = replace(lined(0), verdicts=[missed, missed])
        results[str(number)] = student(str(number), cell)
    (mistake,) = summarize("01_class", WORTH, results).mistakes
    assert mistake == CommonMistake("line", "It keeps time.", 3, "0.5 lines in 1e-0 s", "Look at the timer.")


def test_who_has_not_begun_an_exercise_has_made_no_mistake_in_it(results):
    empty = replace(lined(0), verdicts=[verdict("line", 0, 0, name="runs", sentence=NOT_STARTED)])
    results["anna"] = student("anna", counted(1), empty)
    summary = summarize("01_class", WORTH, results)
    assert summary.unstarted == {"line": 1}
    assert [(one.exercise, one.students) for one in summary.mistakes] == [("line", 2), ("counter", 1)]
    assert "\n\nStudents, of 5, who have not started: line 1\n\nCommon mistakes\n" in as_text(summary)
    assert "<h2>Not started</h2>" in as_page(summary)


def test_a_broken_check_without_words_and_a_stopped_notebook_are_looked_at():
    silent = replace(lined(0, needs_look=True), verdicts=[])
    stopped = student("anna", counted(1), silent, verdict="stopped", reason="It ran on.")
    assert summarize("01_class", WORTH, {"anna": stopped}).concerns[1:] == [
        Concern("anna", "stopped: It ran on."),
        Concern("anna", "a check of nodes/test_line is broken (see its outputs): set the points by hand"),
    ]


def test_what_was_repaired_and_has_few_points_is_looked_at(results):
    repairs = ["It was repaired.", "It was moved."]
    few = student("anna", counted(0.5), lined(0), verdict="repaired", repairs=repairs)
    enough = student("bob", counted(1), lined(0.25), verdict="repaired", repairs=["It was repaired."])
    assert summarize("01_class", WORTH, {"anna": few, "bob": enough}).concerns[1:] == [
        Concern("anna", "repaired, and has 2 of 10 points: It was repaired. It was moved."),
    ]


def test_what_a_flag_says_of_a_test_cell_is_not_said_twice():
    unsure = replace(lined(0), needs_look=True, verdicts=[])
    found = student("anna", counted(1), unsure, flags=["The test cell `test_line`: it broke.", "Odd."])
    assert summarize("01_class", WORTH, {"anna": found}).concerns[1:] == [
        Concern("anna", "The test cell `test_line`: it broke. Set its points by hand."),
        Concern("anna", "Odd."),
    ]


def test_the_page_links_to_the_students_pages(course, results):
    for name in ("anna", "eve & co"):
        page = course.feedback(name, "01_class") / "nodes.html"
        page.parent.mkdir(parents=True)
        page.touch()
    results["eve & co"] = replace(results["eve"], student="eve & co")
    links = page_links(course, "01_class", results, course.root / "class" / "a.html")
    assert links == {
        "anna": "feedback/anna/01_class/nodes.html",
        "eve & co": "feedback/eve%20%26%20co/01_class/nodes.html",
    }
    shown = as_page(summarize("01_class", WORTH, results), links)
    assert '<td><a href="feedback/eve%20%26%20co/01_class/nodes.html">eve &amp; co</a></td>' in shown
    assert "<td>bob</td>" in shown


def test_a_terminal_obeys_nothing_of_the_table():
    result = student("\x1b[2Jann", verdict="refused", reason="\t=1\x1b]0;x\x07", flags=["a\x9b2J"])
    (row,) = csv.DictReader(io.StringIO(as_csv("01_class", {"ann": result})))
    assert [row[name] for name in ("student", "reason", "flags")] == [" [2Jann", "' =1 ]0;x ", "a 2J"]


def test_no_marks_give_a_summary_without_times():
    nothing = summarize("01_class", WORTH, {})
    assert nothing.times is None
    assert as_text(nothing).splitlines()[0].split() == [
        "student", "test_counter", "test_line", "essay", "total", "verdict", "flags",
    ]
    assert "<h2>" not in as_page(nothing)


def test_the_csv_has_a_row_for_each_student_and_exercise(results):
    text = as_csv("01_class", results)
    rows = list(csv.DictReader(io.StringIO(text)))
    assert text.splitlines()[0] == (
        "student,assignment,verdict,notebook,cell,exercise,points,max,missed,needs_look,"
        "flags,repairs,reason,seconds,by_hand,comment,days_late,penalty"
    )
    assert [" ".join((row["student"], row["exercise"], row["points"])) for row in rows[:4]] == [
        "anna counter 4", "anna line 3.0", "bob counter 1.0", "bob line 3.0",
    ]
    assert rows[3]["missed"] == "It keeps time."
    assert rows[3]["flags"] == "The test cell `x` was edited."
    assert rows[3]["seconds"] == "1.0"
    assert rows[5]["needs_look"] == "yes"
    assert rows[6]["repairs"] == "It was repaired."
    assert (rows[8]["student"], rows[8]["verdict"], rows[8]["points"]) == ("eve", "refused", "")
    assert rows[8]["reason"] == "`nodes.ipynb` is empty."


def test_a_spreadsheet_takes_nothing_for_a_formula():
    result = student("=cmd", verdict="refused", reason="@SUM(1)", flags=["+1"], repairs=["-1"])
    (row,) = csv.DictReader(io.StringIO(as_csv("01_class", {"=cmd": result})))
    cells = [row[name] for name in ("student", "reason", "flags", "repairs")]
    assert cells == ["'=cmd", "'@SUM(1)", "'+1", "'-1"]


def test_a_terminal_obeys_nothing_that_a_submission_says(results):
    results["bob"] = replace(results["bob"], flags=["\x1b[2J\x9b gone \u202e backwards\r\n"])
    results["c\x1b[2Jleo"] = replace(results["bob"], student="c\x1b[2Jleo")
    for text in (as_text(summarize("01_class", WORTH, results)), as_csv("01_class", results)):
        assert not set(text) & {"\x1b", "\x9b", "\u202e", "\r"}
        assert "gone" in text and "leo" in text


class Page(HTMLParser):
    """What a page consists of."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.attributes, self.words = set(), set(), []
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attributes}

    def handle_data(self, data):
        self.words.append(data)


def test_the_page_says_the_same_and_loads_and_runs_nothing(results):
    page = Page(as_page(summarize("01_class", WORTH, results)))
    titles = {"Common mistakes", "Needs your attention", "Times"}
    assert titles | {"Look at the timer.", "5.5"} <= set(page.words)
    assert page.tags <= {
        "html", "head", "meta", "title", "style", "body", "h1", "h2", "p",
        "table", "thead", "tbody", "tr", "th", "td",
    }
    assert page.attributes <= {"lang", "charset", "class", "name", "content"}


def test_what_a_submission_says_is_text_in_the_page(results):
    evil = "<script>steal()</script><img src=x onerror=steal()>"
    cell = replace(lined(0), verdicts=[verdict("line", 6, 0, saw=evil, hint=evil)])
    results["bob"] = student(evil, cell, flags=[evil], reason=evil, verdict="stopped")
    page = Page(as_page(summarize("01_class", WORTH, results)))
    assert not page.tags & {"script", "img"}
    assert page.words.count(evil) >= 4


STANDINGS = {
    "anna": Standing(
        {("nodes", "essay"): 4.5, ("nodes", "test_line"): 2.0},
        frozenset({("nodes", "essay"), ("nodes", "test_line")}),
        ((("nodes", "essay"), "=Well argued"),),
        1.5,
        2.0,
    )
}


def test_points_by_hand_comments_and_penalties_are_in_table_csv_and_page(results):
    results = {"anna": results["anna"], "x" * 200: replace(results["bob"], student="x" * 200)}
    summary = summarize("01_class", WORTH, results, STANDINGS, [(".hidden", "is left out")])
    first, _, second, third = as_text(summary).splitlines()[:4]
    assert first.split() == ["student", "counter", "line", "essay", "total", "late", "verdict", "flags"]
    assert second.split() == ["anna", "4", "2", "4.5", "9", "2.0", "d:", "-1.5", "marked"]
    assert third.startswith("x" * 39 + "…  ") and len(third) < 100
    concerns = "  .hidden: is left out\n  nodes/essay: 1 answer has to be marked by hand"
    reported = f"Needs your attention\n{concerns}"
    assert reported in as_text(summary)
    rows = list(csv.DictReader(io.StringIO(as_csv("01_class", results, STANDINGS))))
    about = ("cell", "points", "by_hand", "comment", "days_late", "penalty")
    assert [[row[name] for name in about] for row in rows[:3]] == [
        ["test_counter", "4", "", "", "2.0", "1.5"],
        ["test_line", "2.0", "yes", "", "2.0", "1.5"],
        ["essay", "4.5", "yes", "'=Well argued", "2.0", "1.5"],
    ]
    page = as_page(summary)
    assert "<th>late</th>" in page and "<td>2.0 d: -1.5</td>" in page


def test_a_large_class_is_summed_up_by_tenths_of_the_points():
    many = {f"s{index:03}": student(f"s{index:03}", counted(1), lined(index % 4 / 4)) for index in range(120)}
    flagged = {name: replace(result, flags=["Odd."]) for name, result in many.items()}
    lines = as_text(summarize("01_class", WORTH, flagged)).splitlines()
    assert lines[:4] == [
        "120 students, of 15 points:",
        "   7.5 to    9     30  ##########",
        "     6 to  7.5     30  ##########",
        "   4.5 to    6     30  ##########",
    ]
    assert lines.count("  s000: Odd.") == 1
    assert "  81 more, which are in the file, too" in lines
