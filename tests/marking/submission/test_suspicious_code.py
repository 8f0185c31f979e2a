import json
from pathlib import Path

import pytest

from grader.marking.submission.suspicious_code import find_suspicious_code

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ("source", "what"),
    [
        ("import ctypes", "imports `ctypes`, which reaches into Python's memory"),
        ("from socket import socket", "imports `socket`, which opens connections"),
        ("import grader.checks", "imports `grader.checks`, which is inside the course's own machinery"),
        (
            "from sim.ros.engine.engine import Engine",
            "imports `sim.ros.engine.engine`, which is inside the course's own machinery",
        ),
        *(
            (source, f"imports `{module}`, which is inside the course's own machinery")
            for source, module in [
                ("from grader.exercises.safety.mutants import bench", "grader.exercises.safety.mutants"),
                ("from grader import companions", "grader.companions"),
                ("import grader.exercises.safety.mutants", "grader.exercises.safety.mutants"),
                ("from grader.exercises.safety.mutants import ENOUGH", "grader.exercises.safety.mutants"),
            ]
        ),
        ("import importlib\nimportlib.import_module(x)",
         "uses `importlib.import_module`, which imports by text"),
        ("from importlib import import_module\nimport_module(x)",
         "calls `import_module(...)`, which imports by text"),
        ("import IPython", "imports `IPython`, which changes how cells are run and shown"),
        ("import sys\nsys.modules['grader'] = 1", "uses `sys.modules`, which replaces modules"),
        ("x = f.__globals__", "uses `f.__globals__`, which reaches into another function's module"),
        (
            "get_ipython().ast_transformers.append(x)",
            "uses `get_ipython().ast_transformers`, which rewrites cells before they run",
        ),
        (
            "get_ipython().events.register('pre_run_cell', f)",
            "uses `get_ipython().events`, which runs code around every cell",
        ),
        ("import os\nos._exit(0)", "uses `os._exit`, which ends the process"),
        ("import os\nos.kill(1, 9)", "uses `os.kill`, which stops processes"),
        ("import signal\nx = signal.SIGALRM", "uses `signal.SIGALRM`, which interrupts what runs"),
        ("import rclpy\nrclpy.spin = print", "replaces `rclpy.spin`, which is part of rclpy"),
        (
            "from grader.exercises import topics\ntopics.square.checks = ()",
            "replaces `topics.square.checks`, which is part of grader",
        ),
        (
            "from rclpy.node import Node\nsetattr(Node, 'x', 1)",
            "replaces attributes of `Node`, which is part of rclpy",
        ),
        ("eval('1')", "calls `eval(...)`, which runs text as code"),
        ("!ls", "runs a command of the system's shell, which starts processes"),
        ("if x:\n    files = !ls\n%time x", "runs a command of the system's shell, which starts processes"),
        ("%%bash\ncat .secret", "mentions `.secret`"),
        ("%pylab\nhelp?\n?gc\nx = %who\nimport pty", "imports `pty`, which starts processes"),
        ("a" + ".b" * 400 + ".run_cell", "uses `....run_cell`, which changes how cells are run"),
        ("from sim import run\nrun = 1", "takes the name `run`, which is part of sim"),
        ("def __eq__(a, b):\n    return 1", "defines `__eq__`, which decides what it is equal to"),
        ("open('/x/gradebook.db')", "mentions `gradebook`"),
        ("1" * 20_001, "has more than 20000 characters: it was not searched"),
    ],
)
def test_a_trick_is_named(source, what):
    assert find_suspicious_code([("square", source)]) == [f"The cell `square` {what}."]


@pytest.mark.parametrize("module", ["IPython.display", "IPython.core.display"])
def test_to_show_something_is_no_trick(module):
    assert find_suspicious_code([("a", f"from {module} import HTML\nHTML('<b>here</b>')")]) == []


def test_a_trick_is_named_once_for_each_cell():
    cells = [("a", "import gc\nimport gc"), ("b", "import gc")]
    reason = "imports `gc`, which finds objects that it was not given"
    assert find_suspicious_code(cells) == [f"The cell `a` {reason}.", f"The cell `b` {reason}."]


@pytest.mark.parametrize("source", ["def broken(:", "\0", "(" * 5000, "-" * 19_000 + "1"])
def test_what_is_no_python_is_nothing_suspicious(source):
    assert find_suspicious_code([("a", source)]) == []


def test_a_notebook_without_end_is_looked_through_from_its_beginning():
    cells = [(f"a{number}", "import pty\n" + "a;" * 9_000) for number in range(1000)]
    *found, last = find_suspicious_code(cells)
    assert found == [f"The cell `a{n}` imports `pty`, which starts processes." for n in range(22)]
    message = "and those before it have more than 400000 characters: the rest was not searched."
    assert last == f"The cell `a22` {message}"


@pytest.mark.parametrize("line", ["    %a", "a, b = !ls", "what?", " " * 9_000 + "what?"])
def test_lines_of_ipython_take_no_more_time_than_others(line):
    assert len(find_suspicious_code([("a", f"if 0:\n{line}\n" * (19_000 // len(line)))])) <= 1


@pytest.mark.parametrize("folder", ["course", "solutions", "exercises"])
def test_nothing_in_the_course_is_suspicious(folder):
    """But for other processes that lessons start, which are not submitted."""
    for notebook in (ROOT / folder).glob("*/*.ipynb"):
        cells = json.loads(notebook.read_text())["cells"]
        sources = [(c["id"], "".join(c["source"])) for c in cells if c["cell_type"] == "code"]
        found = find_suspicious_code(sources)
        assert [one for one in found if folder != "course" or "which starts processes" not in one] == []


def test_no_answer_of_the_score_tables_is_suspicious():
    """But for companions and the faults of a package, of which the tests make some answers."""
    made_of = "imports `grader.companions.", "imports `grader.exercises."
    for file in (ROOT / "tests" / "exercises").glob("*/*/students.py"):
        # One answer after the other: a cell as long as all of them isn't searched.
        found = find_suspicious_code([(file.parent.name, part) for part in file.read_text().split("\n\n\n")])
        assert [one for one in found if not any(part in one for part in made_of)] == []


def test_every_trick_with_code_that_only_a_cheat_needs_is_named():
    setup = ("setup", "from grader.exercises import topics\nfrom sim import run")
    silent = {
        file.stem
        for file in (ROOT / "tests" / "students" / "hostile").glob("*.py")
        if not find_suspicious_code([setup, (file.stem, file.read_text())])
    }
    # They are honest mistakes as well, or what they do shows in another way.
    assert silent == {
        "asks_for_input",
        "deep_page",
        "deep_recursion",
        "gets_stuck",
        "outputs_without_end",
        "disk_bomb",
        "endless_loop",
        "forgets_everything",
        "hanging_node",
        "huge_output",
        "leftover_thread",
        "memory_bomb",
        "message_flood",
        "nasty_class",
        "nodes_without_end",
        "print_flood",
        "printed_score",
        "shuts_rclpy_down",
        "speaks_as_the_robot",
        "thread_bomb",
    }
