"""Types that a student defines, when a class is marked: built in the sandbox, decoded with the judge's."""

import copy

import nbformat
import pytest

from grader.marking.pool import Pool
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.exercises.launching.keeper import students as keeper
from tests.marking.tiny import answer, grade

RELEASE = Release(
    "11_small",
    {
        "small": nbformat.v4.new_notebook(
            cells=[
                nbformat.v4.new_code_cell("from grader.exercises import launching", id="setup"),
                answer("own", "# yours"),
                grade("crates-points", 20, 'launching.crates.grade("ws")'),
                grade("keeper-points", 14, 'launching.keeper.grade("ws")'),
            ]
        )
    },
)
FORGED = """\
import sim.ros.messages.codec as codec
import sim.ros.remote.process_link as link
from rclpy.serialization import serialize_message
from std_msgs.msg import String

link.encode = codec.encode = lambda message: serialize_message(String(data="forged"))
"""
SUBMISSIONS = {
    "honest": (keeper.Keeper, "# mine"),
    "another_definition": (keeper.OtherDefinition, "# mine"),
    "a_wrong_message": (keeper.WrongMessage, "# mine"),
    "no_action": (keeper.NoAction, "# mine"),
    "forwards_all": (keeper.ForwardsAll, "# mine"),
    "sends_other_bytes": (keeper.Keeper, FORGED),
}


def task(folder, name):
    """A submission of this name."""
    workspace, cell = SUBMISSIONS[name]
    for path, text in workspace.files.items():
        file = folder / "ws/src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    notebook = copy.deepcopy(RELEASE.notebooks["small"])
    notebook.cells[1].source = cell
    nbformat.write(notebook, folder / "small.ipynb")
    return MarkingTask(name, RELEASE, read_folder(folder, RELEASE), "00")


def marked(folder, names):
    """Name to points of each exercise, and what was seen where something was missed."""
    tasks = []
    for name in names:
        (folder / name).mkdir()
        tasks.append(task(folder / name, name))
    with Pool(2, secret="a secret") as pool:
        results = {result.student: result for result in pool.mark(tasks)}
    cells = {
        name: [cell for book in result.notebooks for cell in book.cells] for name, result in results.items()
    }
    return {
        name: (
            {cell.exercise: cell.points for cell in found if cell.exercise},
            [verdict["saw"] for cell in found for verdict in cell.verdicts if verdict["status"] == "failed"],
        )
        for name, found in cells.items()
    }


def test_a_node_that_uses_types_of_its_own_package_earns_its_points(tmp_path):
    assert marked(tmp_path, ["honest"]) == {"honest": ({"crates": 20.0, "keeper": 14.0}, [])}


@pytest.mark.soak
def test_what_is_wrong_with_types_or_node_costs_what_it_costs_beside_the_notebook(tmp_path):
    found = marked(tmp_path, ["another_definition", "a_wrong_message", "no_action", "forwards_all"])
    assert found == {
        "another_definition": ({"crates": 20.0, "keeper": 14.0}, []),
        "a_wrong_message": (
            {"crates": 17.0, "keeper": 0.0},
            ["string label, float32 mass, uint8 state, geometry_msgs/Point place", "Crate has other fields"],
        ),
        "no_action": (
            {"crates": 16.0, "keeper": 0.0},
            ["msg/Crate.msg, srv/FindCrates.srv", "none for action/Lift.action", "Lift is not built"],
        ),
        "forwards_all": ({"crates": 20.0, "keeper": 10.0}, ["“elm”"]),
    }


@pytest.mark.soak
def test_a_process_whose_messages_are_no_message_of_the_type_earns_nothing(tmp_path):
    assert marked(tmp_path, ["sends_other_bytes"]) == {
        "sends_other_bytes": ({"crates": 20.0, "keeper": 0.0}, [])
    }
