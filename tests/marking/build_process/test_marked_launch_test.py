"""A launch test marked in the sandbox, where its processes are programs of the run as well."""

import nbformat
import pytest

from grader.marking.pool import Pool
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.exercises.testing.launch_test.students import RIGHT, LeavesItRunning
from tests.marking.student_processes import USUAL
from tests.marking.tiny import answer, grade


@pytest.mark.soak
def test_a_launch_test_is_marked_in_the_sandbox(tmp_path):
    cells = [
        nbformat.v4.new_code_cell("from grader.exercises import testing", id="setup"),
        answer("launch_test", "# yours"),
        grade("launch_test-points", 6, 'testing.launch_test.grade("ws")'),
    ]
    release = Release("11_tiny", {"tiny": nbformat.v4.new_notebook(cells=cells)})
    tasks = []
    for name, files in {"right": RIGHT, "leaves": LeavesItRunning.files}.items():
        for path, content in files.items():
            file = tmp_path / name / "ws/src" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content)
        notebook = nbformat.from_dict(release.notebooks["tiny"])
        notebook.cells[1].source = "# mine"
        nbformat.write(notebook, tmp_path / name / "tiny.ipynb")
        tasks.append(MarkingTask(name, release, read_folder(tmp_path / name, release), name))
    with Pool(2, secret="a secret", time_limits=USUAL) as pool:
        results = {result.student: result for result in pool.mark(tasks)}
    assert (results["right"].points, results["right"].repairs, results["right"].flags) == (6.0, [], [])
    outputs = str([cell["outputs"] for cell in results["leaves"].notebooks[0].notebook["cells"]])
    assert results["leaves"].points == 0.0
    assert "left running: limiter" in outputs
