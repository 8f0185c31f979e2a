"""A program of the course that sends commands to a robot stops it on Ctrl-C."""

import json
import re
from collections.abc import Iterator

from tests.rules.table import ROOT

PROGRAM = re.compile(r"^def main\(", re.M)
SENDS = re.compile(r"create_publisher\(Twist,|publish\(Twist\(\)\)")  # the second: a main that packages share
ZEROS = r"(publish\(Twist\(\)\)|drive\(0\.0, 0\.0\)|send\(\))"
STOPS = re.compile(rf"SignalHandlerOptions\.NO.*except KeyboardInterrupt:.*finally:\n.*{ZEROS}", re.S)


def programs() -> Iterator[tuple[str, str]]:
    """Each file and cell of code, and each block of Python in a text, with the place where it is."""
    for path in sorted([*ROOT.glob("course/**/*.py"), *ROOT.glob("grader/companions/*.py"),
                        *ROOT.glob("grader/exercises/**/*.py")]):
        yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")
    for path in sorted([*ROOT.glob("course/**/*.ipynb"), *ROOT.glob("solutions/**/*.ipynb")]):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            text = "".join(cell["source"])
            blocks = [text] if cell["cell_type"] == "code" else re.findall(r"```python\n(.*?)```", text, re.S)
            yield from ((f"{path.relative_to(ROOT).as_posix()}: {cell['id']}", block) for block in blocks)


def test_programs_that_drive_a_robot_send_zeros_on_ctrl_c():
    drives = {place: text for place, text in programs() if PROGRAM.search(text) and SENDS.search(text)}
    assert len(drives) >= 8
    assert [place for place, text in drives.items() if not STOPS.search(text)] == []
