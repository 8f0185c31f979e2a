"""What a run shows at its end when a program of the user has failed."""

import io
import logging

import pytest

from sim import Recording, run
from sim.evidence import CallbackError, Ended
from sim.notebook import failure_report, report_failure


class Crash(Exception):
    pass


class Screen(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def failed() -> Recording:
    trace = '  File "<cell>", line 7, in tick\n'
    error = CallbackError(1.0, "/talker", "Talker.tick", "ValueError", "x < 0 & y", trace)
    return Recording(seconds=3.0, errors=[error], ended=Ended("error", 1.0, ""))


def test_the_report_is_red_and_legible_without_a_style_sheet(failed):
    page = failure_report.failure_html(failure_report.failure_lines(failed))
    assert page.startswith('<div class="ros2-failure" style="color: #8c1d18; background-color: #fdecea;')
    assert "<strong>ValueError: x &lt; 0 &amp; y (in Talker.tick, line 7, at 1 s)</strong></div>" in page


def test_code_in_a_line_is_shown_as_code_in_the_color_of_the_box():
    code = '<code style="color: inherit; background: none">'
    page = failure_report.failure_html(["A `<main>()` ends.", "Hint: write `a`, or `b`."])
    assert f"<strong>A {code}&lt;main&gt;()</code> ends.</strong>" in page
    assert f"<br>Hint: write {code}a</code>, or {code}b</code>.</div>" in page


def test_a_terminal_shows_it_in_red_and_a_file_does_not(failed, monkeypatch, capsys):
    monkeypatch.setattr("sys.stderr", Screen())
    report_failure(failed)
    import sys

    said = "\x1b[31mValueError: x < 0 & y (in Talker.tick, line 7, at 1 s)\x1b[0m\n"
    assert sys.stderr.getvalue() == said
    monkeypatch.undo()
    report_failure(failed)
    assert capsys.readouterr().err == ""


def test_without_an_explanation_the_error_remains(failed, monkeypatch, caplog):
    class Missing:
        value = "nowhere:explain"

        def load(self):
            raise ImportError("no nowhere")

    monkeypatch.setattr(failure_report, "entry_points", lambda group: [Missing()])
    with caplog.at_level(logging.WARNING):
        assert failure_report.failure_lines(failed) == [failed.failure]
    assert caplog.messages == ["nowhere:explain can't be loaded: no nowhere"]


def test_a_failure_of_the_course_is_not_one_of_the_user(failed):
    failed.course_errors = list(failed.errors)
    assert failed.failure == "" and failure_report.failure_lines(failed) == []


def test_a_program_outside_a_notebook_shows_nothing(capfd):
    def main():
        raise Crash("here")

    assert run(main, quiet=True).failure.startswith("Crash: here (in main, line ")
    assert capfd.readouterr() == ("", "")
