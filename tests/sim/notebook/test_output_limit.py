"""A cell that prints without end shows a part of it, and the rest is counted."""

import pytest

from sim.notebook.output_limit import (
    CHARACTERS,
    CLEARS,
    DISPLAYS,
    LINES,
    OVERWRITTEN,
    TOO_MUCH,
    CellOutput,
    shorten,
)
from tests.patience import PATIENCE
from tests.sim.notebook.test_kernel import Kernel


def test_all_is_shown_up_to_the_limit():
    output = CellOutput()
    assert output.fit("OK\n" * LINES) == "OK\n" * LINES
    assert output.hidden() == ""
    assert output.fit("OK") == TOO_MUCH
    assert output.fit("\n") == ""
    assert output.hidden() == "... and 3 more characters.\n"


def test_a_line_that_is_not_finished_ends_before_the_sentence():
    output = CellOutput()
    assert output.fit("x" * (CHARACTERS + 5)) == "x" * CHARACTERS + "\n" + TOO_MUCH
    assert output.hidden() == "... and 5 more characters.\n"


def test_text_that_a_progress_bar_overwrites_counts_little():
    output, bar = CellOutput(), "\r" + 99 * "#"
    pieces = [output.fit(bar) for _ in range(OVERWRITTEN // 100)]
    assert set(pieces) == {bar}
    assert output.fit(bar) == "\n" + TOO_MUCH
    assert CellOutput().fit("one\r\ntwo\r\n") == "one\r\ntwo\r\n"


def test_an_animation_that_clears_its_output_goes_on_for_long():
    output = CellOutput()
    for _ in range(CLEARS - 1):
        assert output.fit("x\n" * 10) == "x\n" * 10
        assert output.clear()
    assert not output.clear()


def test_displays_are_counted():
    output = CellOutput()
    assert [output.allows_display() for _ in range(DISPLAYS + 2)] == [True] * DISPLAYS + [False] * 2
    output.fit("x\n" * (LINES + 1_500))
    assert output.hidden() == "... and 1,500 more lines and 2 more outputs.\n"


def test_a_long_result_is_cut():
    data = {"text/plain": "x" * (CHARACTERS + 1_234), "text/html": "<b>"}
    cut = "x" * CHARACTERS + "\n... and 1,234 more characters"
    assert shorten(data) == {"text/plain": cut, "text/html": "<b>"}
    assert shorten({"image/png": "x"}) == {"image/png": "x"}


CELLS = {
    "print": "for _ in range(5000): print('OK')",
    "a thread": "import threading\nt = threading.Thread(target=lambda: [print('T') for _ in range(5000)])\n"
    "t.start(); t.join()",
    "stderr": "import sys\nfor _ in range(5000): print('E', file=sys.stderr)",
    "%%bash": "%%bash\nseq 1 5000",
}


@pytest.fixture(scope="module")
def kernel(tmp_path_factory):
    kernel = Kernel(tmp_path_factory.mktemp("kernel") / "none.ipynb")
    yield kernel
    kernel.client.stop_channels()
    kernel.manager.shutdown_kernel(now=True)


def _texts(kernel, request):
    """The streams and errors of a request, until the kernel is idle again."""
    texts = []
    while True:
        message = kernel.client.get_iopub_msg(timeout=PATIENCE)
        if message["parent_header"].get("msg_id") != request:
            continue
        content = message["content"]
        if content.get("execution_state") == "idle":
            return texts
        texts += [content["text"]] if message["msg_type"] == "stream" else []
        texts += [content["ename"]] if message["msg_type"] == "error" else []


@pytest.mark.parametrize("what", CELLS)
def test_what_a_cell_prints_in_any_way_is_limited(kernel, what):
    shown = "".join(_texts(kernel, kernel.client.execute(CELLS[what])))
    assert shown.endswith(f"{TOO_MUCH}... and 3,000 more lines.\n")
    assert shown.count("\n") == LINES + 2


def test_an_endless_loop_is_interrupted_and_the_next_cell_is_shown_whole(kernel):
    request = kernel.client.execute("while True: print('OK')")
    shown = ""
    while TOO_MUCH not in shown:
        message = kernel.client.get_iopub_msg(timeout=PATIENCE)
        shown += message["content"].get("text", "")
    kernel.manager.interrupt_kernel()
    *_, error, rest = _texts(kernel, request)
    assert error == "KeyboardInterrupt" and rest.startswith("... and ") and rest.endswith(" more lines.\n")
    assert _texts(kernel, kernel.client.execute("print('fine')")) == ["fine\n"]
