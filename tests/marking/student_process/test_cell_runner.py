import time

import pytest

from grader.marking.errors import StudentProcessGone
from tests.marking.student_processes import USUAL
from tests.patience import PATIENCE

NODE = """\
from rclpy.node import Node
from sim import play, run

class Clock(Node):
    def __init__(self):
        super().__init__("clock")
        self.create_timer(1.0, lambda: self.get_logger().info("tick"))
"""

ENDLESS = "def endless():\n    while True:\n        pass"


def value(outputs: list[dict]) -> str:
    assert outputs[-1]["output_type"] == "execute_result"
    return outputs[-1]["data"]["text/plain"]


def error(outputs: list[dict]) -> list[str]:
    return next(output["traceback"] for output in outputs if output["output_type"] == "error")


def test_a_cell_shows_text_and_the_value_of_its_last_line(student):
    assert student.run("print('a')\n6 * 7") == [
        {"output_type": "stream", "name": "stdout", "text": "a\n"},
        {"output_type": "execute_result", "data": {"text/plain": "42"}, "metadata": {}, "execution_count": 1},
    ]


def test_cells_share_their_names(student):
    student.run("x = 5")
    assert value(student.run("x + 1")) == "6"
    assert value(student.run("_")) == "6"


def test_a_class_of_a_cell_belongs_to_main(student):
    assert value(student.run("class A: pass\nA.__module__")) == "'__main__'"


def test_a_module_that_a_cell_writes_can_be_imported(student):
    student.run("%%writefile my_weather.py\nWORD = 'mild'")
    assert value(student.run("import my_weather\nmy_weather.WORD")) == "'mild'"


def test_stderr_and_what_c_code_writes_show_too(student):
    student.run("import os, sys")
    source = "print('python', file=sys.stderr)\n_ = os.write(1, b'c one') + os.write(2, b'c two')"
    assert student.run(source) == [
        {"output_type": "stream", "name": "stderr", "text": "python\n"},
        {"output_type": "stream", "name": "stdout", "text": "c one"},
        {"output_type": "stream", "name": "stderr", "text": "c two"},
    ]
    assert student.run("pass") == []


def test_an_error_shows_the_students_lines_and_the_next_cell_runs(student):
    lines = ["In [1], line 1:", "    1 / 0", "ZeroDivisionError: division by zero"]
    assert error(student.run("1 / 0")) == lines
    assert value(student.run("1")) == "1"


def test_code_that_cant_be_read_is_shown(student):
    assert error(student.run("def f(:"))[-1] == "SyntaxError: invalid syntax"
    assert error(student.run("  x = 1\n y = 2"))[-1].startswith("IndentationError")
    assert value(student.run("1")) == "1"


def test_a_figure_of_pyplot_shows_without_show(student):
    outputs = student.run("import matplotlib.pyplot as plt\n_ = plt.plot([1, 2])")
    assert [list(output["data"]) for output in outputs] == [["text/plain", "image/png"]]
    assert student.run("pass") == []


def test_displays_can_be_updated_and_cleared(student):
    student.run("from IPython.display import HTML, clear_output, display")
    first = student.run("handle = display('a', display_id=True)")
    assert student.run("handle.update('b')") == []
    assert first[0]["data"] == {"text/plain": "'b'"}
    assert student.text("print(1)\nclear_output()\nprint(2)") == "2\n"
    assert student.run("HTML('<b>x</b>')")[0]["data"]["text/html"] == "<b>x</b>"


def test_magics_work(student):
    assert student.text("%%capture caught\nprint('a')") == ""
    assert value(student.run("caught.stdout")) == r"'a\n'"


def test_a_cell_may_await_and_what_it_starts_goes_on_in_later_cells(student):
    student.run("import asyncio\nfound = []")
    student.run("async def later():\n    await asyncio.sleep(0)\n    found.append(1)")
    student.run("task = asyncio.create_task(later())")
    assert value(student.run("await task\nfound")) == "[1]"


def test_a_run_shows_what_its_nodes_say(student):
    student.run(NODE)
    text = student.text("_ = run(Clock, seconds=2)")
    assert text == "[INFO] [1.000] [clock]: tick\n[INFO] [2.000] [clock]: tick\n"


def test_a_robot_that_plays_plays_on_while_a_cell_awaits(student):
    student.run(NODE + "player = play(Clock, seconds=0.1)")
    assert value(student.run("(await player).ended.reason")) == "'time'"


def test_files_of_the_release_lie_beside_the_notebook(start_student):
    student = start_student(**{"map.txt": b"wall", "data/a.bin": b"\0"})
    assert value(student.run("open('map.txt').read()")) == "'wall'"
    assert value(student.run("open('data/a.bin', 'rb').read()")) == r"b'\x00'"


def test_sys_exit_ends_the_cell_only(student):
    exit = "import sys\nsys.exit(3)"
    assert error(student.run(exit)) == ["In [1], line 2:", "    sys.exit(3)", "SystemExit: 3"]
    assert value(student.run("1")) == "1"


def test_an_interrupt_of_the_students_own_ends_the_cell_only(student):
    assert error(student.run("raise KeyboardInterrupt"))[-1] == "KeyboardInterrupt"
    assert value(student.run("1")) == "1"


def test_no_input_is_given(student):
    assert error(student.run("input('name? ')"))[-1] == "EOFError: EOF when reading a line"


@pytest.mark.parametrize(
    "endless",
    [
        "while True: pass",
        "import time\nwhile True: time.sleep(9)",
        "import asyncio\nawait asyncio.get_running_loop().create_future()",
    ],
)
def test_an_endless_cell_is_interrupted_and_the_next_one_runs(start_student, endless):
    student = start_student(quick=endless)
    assert student.text(endless) == "This cell was interrupted: it took more than 0.5 s.\n"
    assert value(student.run("1")) == "1"


def test_runs_without_end_in_a_cell_are_interrupted(start_student):
    student = start_student(quick="while")
    student.run(NODE)
    text = student.text("while True:\n    _ = run(Clock, seconds=1, quiet=True)")
    assert text.endswith("more than 0.5 s.\n")
    assert value(student.run("1")) == "1"


# No time passes for the process until the cell says `begin.release()`: then what it says next is interrupted.
TIME_BEGINS_LATER = """
import threading
from types import SimpleNamespace
from grader.marking.student_process import interrupter

begin = threading.Semaphore(0)

class Event(threading.Event):
    def wait(self, seconds):
        begin.acquire()
        return super().wait(0.3)

    def set(self):
        super().set()
        begin.release()

interrupter.threading = SimpleNamespace(**{**vars(threading), "Event": Event})
"""
CATCHES_ONCE = """
try:
    begin.release()
    endless()
except KeyboardInterrupt:
    print('once')
begin.release()
endless()
"""


def test_code_that_catches_the_interrupt_gets_another(start_student):
    student = start_student(quick=CATCHES_ONCE)
    student.run(ENDLESS)
    assert student.run(TIME_BEGINS_LATER) == []
    message = student.text(CATCHES_ONCE)
    assert message == "once\nThis cell was interrupted: it took more than 0.5 s.\n"


def test_a_cell_that_cant_be_interrupted_ends_the_notebook(start_student, monkeypatch):
    monkeypatch.setattr("grader.marking.judge.student_session.GRACE", 0.1)
    student = start_student(quick="while True:\n    try")
    student.run(ENDLESS)
    with pytest.raises(StudentProcessGone, match=r"^It did not stop when it was interrupted.$"):
        student.run("while True:\n    try:\n        endless()\n    except BaseException:\n        pass")


def test_all_cells_together_have_their_time(start_student, monkeypatch):
    student = start_student()
    student.run("x = 1")
    later = time.monotonic() + USUAL.notebook
    monkeypatch.setattr("grader.marking.judge.student_session.monotonic", lambda: later)
    with pytest.raises(StudentProcessGone, match=r"^All its cells together took more than 6000 s.$"):
        student.run("x")


@pytest.mark.parametrize("end", ["quit()", "exit()", "get_ipython().ask_exit()"])
def test_quit_ends_the_notebook_after_its_cell(student, end):
    assert student.text(f"{end}\nprint('still here')") == "still here\n"
    with pytest.raises(StudentProcessGone, match=r"^The process ended by itself.$"):
        student.run("1")


def test_what_was_shown_before_a_process_ended_is_kept(student):
    with pytest.raises(StudentProcessGone, match=r"^The process ended by itself, with exit status 3.$"):
        student.run("import os\nprint('last words')\nos._exit(3)")
    assert student.outputs.printed_text == "last words\n"


def test_a_crash_ends_the_notebook_and_is_named(student):
    with pytest.raises(StudentProcessGone, match=r"^The process crashed: Segmentation fault.$"):
        student.run("import ctypes\nctypes.string_at(0)")


def test_a_flood_of_text_is_cut(student):
    text = student.text("for _ in range(40): print('x' * 100_000)")
    assert text.endswith("[This cell showed more than a notebook can hold. The rest is left out.]\n")
    assert len(text) < 1_001_000


def test_an_output_that_is_too_large_is_left_out(student):
    text = student.text("from IPython.display import HTML\nHTML('x' * 10**7)")
    assert text == "\n[This cell showed more than a notebook can hold. The rest is left out.]\n"


def test_threads_may_write(student):
    source = "import threading\nts = [threading.Thread(target=print, args=('x',)) for _ in range(50)]"
    assert student.text(f"{source}\nfor t in ts: t.start()\nfor t in ts: t.join()").count("x") == 50


def test_a_student_who_breaks_ipython_sees_the_error(student):
    student.run("get_ipython().transform_cell = None")
    assert error(student.run("1")) == ["TypeError: 'NoneType' object is not callable"]


def test_an_error_while_something_is_shown_is_an_error_of_the_cell(student):
    source = "class A:\n    def __repr__(self):\n        raise ValueError('bad')\nA()"
    assert error(student.run(source)) == [
        "In [1], line 3, in __repr__:", "    raise ValueError('bad')", "ValueError: bad",
    ]


def test_a_process_without_a_judge_ends(start_student):
    student = start_student()
    student.student.close()
    assert student.process.wait(PATIENCE).kind == "exited"
