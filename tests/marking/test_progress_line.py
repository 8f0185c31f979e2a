import io

import pytest

from grader.marking.progress_line import ProgressLine, printable
from grader.marking.result import CellResult, NotebookResult, Result


def marked(student):
    note = NotebookResult("nodes", {}, [CellResult("a", "a", 1.5, 4.0), CellResult("b", "b", 2.0, 6.0)])
    return Result(student, "01_class", "00", "marked", notebooks=[note])


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_elsewhere_each_submission_has_a_line():
    stream = io.StringIO()
    progress = ProgressLine(2, stream)
    progress.add_result(marked("anna"))
    progress.add_result(marked("b\x1b[2Job"))
    progress.close()
    assert stream.getvalue() == (
        "1 of 2  anna: 3.5 of 10 points, marked\n2 of 2  b [2Job: 3.5 of 10 points, marked\n"
    )


FAST, SLOW = "0.5 each second, 6 s left", "0.01 each second, 5 min 0 s left"


@pytest.mark.parametrize(("now", "left"), [(2.0, FAST), (100.0, SLOW)])
def test_on_a_terminal_one_line_changes_and_goes(now, left, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    stream, times = Terminal(), iter([0.0, now])
    progress = ProgressLine(4, stream, lambda: next(times))
    progress.add_result(marked("anna"))
    assert stream.getvalue() == f"\r\x1b[K1 of 4, {left}  anna: 3.5 of 10 points, marked"
    progress.close()
    assert stream.getvalue().endswith("marked\r\x1b[K")


def test_those_that_are_marked_already_are_counted_and_not_in_the_rate(monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    stream, times = Terminal(), iter([0.0, 2.0])
    progress = ProgressLine(4, stream, lambda: next(times))
    progress.skip()
    progress.add_result(marked("anna"))
    assert stream.getvalue() == (
        "\r\x1b[K2 of 4, 0.5 each second, 4 s left  anna: 3.5 of 10 points, marked"
    )


def test_a_narrow_terminal_gets_a_short_line(monkeypatch):
    monkeypatch.setenv("COLUMNS", "20")
    stream = Terminal()
    ProgressLine(4, stream).add_result(marked("anna"))
    assert len(stream.getvalue().removeprefix("\r\x1b[K")) == 19


def test_plain_words_have_nothing_that_a_terminal_obeys():
    assert printable("é ✔ \x07\x1b]0;x\x9c") == "é ✔   ]0;x "
