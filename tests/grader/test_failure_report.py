"""In a notebook: what the grader says when a program of a run has failed."""

import pytest

from tests.sim.notebook.test_kernel import Kernel

CELLS = """
from rclpy.node import Node
from grader import tell
from sim import run
class B(Node):
    def __init__(self):
        super().__init__("b")
        self.create_timer(0.5, self.tick)
    def tick(self):
        1 / 0
"""


SAW = "ZeroDivisionError: division by zero (in B.tick, cell [1], line 9, at 0.5 s)"


HINT = "Hint: The number after `/`, `//` or `%` on that line is 0 at that moment."


@pytest.fixture(scope="module")
def kernel(tmp_path_factory):
    kernel = Kernel(tmp_path_factory.mktemp("failure") / "failure.ipynb")
    kernel.run(CELLS, "setup")
    yield kernel
    kernel.client.stop_channels()
    kernel.manager.shutdown_kernel(now=True)


@pytest.mark.parametrize("quiet", ["", ", quiet=True"])
def test_a_cell_ends_with_the_error_its_cell_and_line_and_a_hint(kernel, quiet):
    shown = kernel.run(f"recording = run(B{quiet})", "use").strip()
    assert shown.startswith(f"{SAW}\n{HINT}")


def test_a_hanging_program_is_reported_too(kernel):
    kernel.run("def main():\n    while True: pass", "main")
    shown = kernel.run("recording = run(main)", "use").strip()
    assert (
        shown.startswith("main() at t = 0 s computed for") and "Hint: A main() that loops by itself" in shown
    )


def test_a_run_that_fails_on_purpose_says_so_and_shows_nothing(kernel):
    assert kernel.run("recording = run(B, expect_error=True)", "use").strip() == ""


def test_tell_does_not_repeat_what_run_has_shown_in_the_same_cell(kernel):
    assert kernel.run("recording = run(B)\ntell(recording)", "use").count("ZeroDivisionError") == 1
    code = (
        "import contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()) as out: tell(recording)\nout"
    )
    assert SAW in kernel.run(code.replace("\nout", "\nout.getvalue()"), "later")
