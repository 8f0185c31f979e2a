"""Each program has a command line and a keyboard of its own."""

import sys

import pytest

from sim import Process, run
from tests.sim.ros.evidence import logged, raised
from tests.students.engine import command_line

NO_TERMINAL = (
    "input() waits for a person at the keyboard; give it lines, as in run(Process(main, "
    'stdin=["first line", "second line"])), or let the node get its input from topics and parameters'
)


def received(*programs, seconds=1):
    """What is logged, by whom, in a run without errors."""
    recording = run(*programs, seconds=seconds, quiet=True)
    assert raised(recording) == []
    return [(line.stamp, line.node, line.text) for line in recording.logs]


def test_a_programs_own_words_are_its_argv():
    program = Process(command_line.reads_words, arguments=["3", "4"])
    assert received(program) == [(0.0, "reader", "3 + 4")]


def test_a_program_without_words_has_its_name_alone():
    assert received(command_line.shows_words) == [(0.0, "shows", "shows_words")] * 2


def test_words_of_ros_come_after_ros_args():
    words = ["3", "--ros-args", "-r", "__ns:=/left", "--", "4"]
    program = Process(command_line.shows_words, name="other", arguments=words)
    assert received(program) == [
        (0.0, "left.other", "shows_words 3 --ros-args -r __ns:=/left -- 4 --ros-args -r __node:=other"),
        (0.0, "left.other", "shows_words 3 4"),
    ]


def test_words_that_look_like_ros_are_the_programs_without_ros_args():
    program = Process(command_line.shows_words, arguments=["-p", "rate"])
    assert received(program) == [(0.0, "shows", "shows_words -p rate")] * 2


def test_argparse_reads_them():
    program = Process(command_line.parses_words, name="fast", arguments=["--speed", "0.4"])
    assert received(program) == [(0.5, "fast", "speed 0.4"), (1.0, "fast", "speed 0.4")]


def test_each_program_has_its_own_words():
    before = list(sys.argv)
    programs = [Process(command_line.changes_words, name=name, arguments=[name]) for name in ("one", "two")]
    assert received(*programs, seconds=0.5) == [
        (0.5, "one", "changes_words mine one --ros-args -r __node:=one"),
        (0.5, "two", "changes_words mine two --ros-args -r __node:=two"),
    ]
    assert sys.argv == before


def test_init_with_no_words_sees_none():
    assert received(Process(command_line.no_ros_words, name="other")) == [(0.0, "plain", "here")]


def test_a_program_without_lines_learns_how_to_get_some():
    recording = run(command_line.asks, seconds=1, quiet=True)
    assert raised(recording) == [(0.0, "/asks", "asks", "RuntimeError", NO_TERMINAL)]
    recording = run(command_line.reads_stdin, seconds=1, quiet=True)
    assert raised(recording) == [(0.0, "/reads", "reads_stdin", "RuntimeError", NO_TERMINAL)]


def test_input_returns_one_line_after_the_other():
    recording = run(Process(command_line.asks, stdin=["left", "", "right"]), seconds=1, quiet=True)
    assert logged(recording) == [(0.0, "left"), (0.0, ""), (0.0, "right"), (0.0, "EOF when reading a line")]
    assert "".join(text for _, text in recording.prints) == "word? " * 4


def test_each_program_reads_its_own_lines():
    before = sys.stdin
    one = Process(command_line.asks_now_and_then, name="one", stdin=["a", "b"])
    two = Process(command_line.asks_now_and_then, name="two", stdin=["c", "d"])
    assert received(one, two) == [(0.5, "one", "a"), (0.5, "two", "c"), (1.0, "one", "b"), (1.0, "two", "d")]
    assert sys.stdin is before


def test_stdin_can_be_read_as_a_file():
    assert received(Process(command_line.reads_stdin, stdin=["a", "b"])) == [
        (0.0, "reads", "'a\\n'"),
        (0.0, "reads", "'b\\n'"),
    ]


@pytest.mark.parametrize("lines", [None, ["w"]])
def test_single_keys_are_refused(lines):
    ((*_, kind, words),) = raised(run(Process(command_line.reads_keys, stdin=lines), seconds=1, quiet=True))
    assert (kind, words) == (
        "UnsupportedOperation",
        "a run has no terminal whose keys can be read one by one; give the program lines, as in "
        'run(Process(main, stdin=["first line", "second line"])) for input(), or drive in the picture of '
        "play()",
    )
