"""A look at a package of interfaces, and what the real tools say of each one."""

import subprocess
import sys
from pathlib import Path

import pytest

from grader.exercises import launching
from tests.exercises.launching.crates import students as crates
from tests.students.workspaces import Workspace

TARGET = "crate_interfaces__rosidl_generator_type_description"  # what comes first, before any compiler
FIELD = "Write a field's name with lower-case letters, digits and single underscores, such as top_speed."


def test_a_look_prints_the_definitions_as_they_are_read(capsys):
    definitions = crates.changed(crates.RIGHT, crates.LIFT, "bool lifted", "bool Lifted")
    assert launching.see(launching.crates, Workspace(__name__, definitions)).seconds == 0
    assert capsys.readouterr().out == f"""\
crate_interfaces/action/Lift
    line 4: bool Lifted
    Hint: {FIELD}
crate_interfaces/msg/Crate
    uint8 EMPTY=0
    uint8 FULL=1
    string label
    float64 mass
    uint8 state
    geometry_msgs/Point place
crate_interfaces/srv/FindCrates
    float64 heaviest
    ---
    Crate[] crates
The types could not be built.
"""


@pytest.mark.soak  # each takes 11 s of computing
@pytest.mark.parametrize(
    ("name", "status"),
    [
        *((name, 0) for name in ("Crates", "ListsOfFiles", "WrittenOtherwise")),
        *((name, 0) for name in ("SavedOnWindows", "MarkedByAnEditor", "SpacesAndTabs")),
        *((name, 1) for name in ("MarkedDefinition", "SpaceOfAPage", "CommentAfterDashes")),
        *((name, 1) for name in ("SmallLetters", "TwoSlashes", "NoGroup", "OtherProject")),
        *((name, 1) for name in ("FindsNoGenerators", "FindsNoGeometry", "NoVersion")),
        *((name, 1) for name in ("OneTooMany", "OpenBracket")),
        ("NoDependencies", 2),
    ],
)
def test_the_real_tools_say_the_same(name, status):
    workspace, colcon = getattr(crates, name), Path(sys.executable).with_name("colcon")
    words = "--log-base", "/dev/null", "build", "--cmake-target", TARGET
    done = subprocess.run([colcon, *words], cwd=workspace.__fspath__(), capture_output=True, check=False)
    assert done.returncode == status, done.stderr
