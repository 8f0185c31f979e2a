"""Where code is, in Python's frames and tracebacks."""

import importlib.util
import inspect
import shutil

import pytest
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

from sim import run
from sim.evidence import frames_of, place_of
from sim.ros.engine import guard
from sim.ros.recorder.tracebacks import line_at, student_line, student_traceback
from tests.students.engine import hangs


def without_lines(function):
    """Give all instructions of a function no line, as the compiler does for some jumps of loops."""
    eights, rest = divmod(len(function.__code__.co_code) // 2, 8)
    table = b"\xff" * eights + (bytes([0xF7 + rest]) if rest else b"")  # Python's Objects/locations.md
    function.__code__ = function.__code__.replace(co_linetable=table)
    return function


class LoopWithoutLines(hangs.Loop):
    @without_lines
    def tick(self):
        while True:
            pass


@without_lines
def divides():
    return 1 / 0


def loops(waiting):
    while waiting:
        for number in waiting.pop():
            if number:
                waiting.append(number)
    return []


def first_line(function):
    return function.__code__.co_firstlineno


def test_an_instruction_without_a_line_is_at_the_one_before():
    line = first_line(loops)
    for begin, _, known in loops.__code__.co_lines():
        found = line_at(loops.__code__, begin)
        assert found == (known or line)
        line = found


def test_a_loop_is_stopped_where_its_code_has_no_line(monkeypatch):
    monkeypatch.setattr(guard, "COMPUTING_LIMIT", 0.2)
    ended = run(LoopWithoutLines, seconds=2, quiet=True).ended
    where = f"at line {first_line(LoopWithoutLines.tick)}: @without_lines."
    assert (ended.reason, ended.detail.split(", ")[-1]) == ("hang", where)


def test_the_code_that_rosidl_generates_is_no_code_of_the_student(tmp_path):
    """A service that is built in a workspace is in no folder of libraries."""
    built = tmp_path / "install" / "own" / "srv" / "_add_two_ints.py"
    built.parent.mkdir(parents=True)
    shutil.copy(inspect.getsourcefile(AddTwoInts.Request), built)
    spec = importlib.util.spec_from_file_location("_add_two_ints", built)
    spec.loader.exec_module(module := importlib.util.module_from_spec(spec))

    class Asks(Node):
        def __init__(self):
            super().__init__("asks")
            module.AddTwoInts_Request(nope=[])

    (error,) = run(Asks, seconds=1, quiet=True).errors
    line = first_line(Asks.__init__) + 2
    assert place_of(error) == f"in Asks, line {line}, at 0 s"
    assert [frame[2] for frame in frames_of(error)] == ["__init__"]


def test_a_traceback_names_the_function_where_the_code_has_no_line():
    with pytest.raises(ZeroDivisionError) as caught:
        divides()
    last = student_traceback(caught.value).splitlines()[-3:]
    assert last[0].strip() == f'File "{__file__}", line {first_line(divides)}, in divides'
    assert last[-1] == "ZeroDivisionError: division by zero"
    assert student_line(caught.value.__traceback__.tb_next.tb_frame).startswith(
        f", at line {first_line(divides)}: "
    )
