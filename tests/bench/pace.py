"""How fast marks come: simulated seconds judged in a second, by the clock on the wall and of computing."""

import shutil
import tempfile
import time
from pathlib import Path

from grader.marking.command.cli import USUAL_JOBS
from grader.marking.pool import Pool
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.bench.report import table

STUDENTS = 8
COURSE = Path.cwd()


def paced(assignment: str, folder: Path) -> list[object]:
    """Mark right submissions of so many students in their sandboxes; a line of the table."""
    shutil.copytree(COURSE / "solutions" / assignment, folder / assignment)
    released = load_release(COURSE / "exercises" / assignment)
    read = read_folder(folder / assignment, released)
    tasks = [MarkingTask(f"student_{number}", released, read, "0" * 64) for number in range(STUDENTS)]
    began = time.perf_counter()
    with Pool(USUAL_JOBS, secret="a secret") as pool:
        results = list(pool.mark(tasks))
    wall = time.perf_counter() - began
    cells = [cell for result in results for notebook in result.notebooks for cell in notebook.cells]
    if not cells or any(cell.points < cell.max for cell in cells):
        raise RuntimeError(f"the solutions of {assignment} did not get all points")
    judged = sum(result.timings["judged"] for result in results)
    computing = sum(result.timings["computing"] for result in results)
    seconds = [f"{judged / STUDENTS:.0f}", f"{wall / STUDENTS:.2f}", f"{computing / STUDENTS:.2f}"]
    return [assignment, *seconds, f"{judged / wall:.0f}", f"{judged / computing:.0f}"]


def main() -> None:
    """All assignments, one after the other."""
    with tempfile.TemporaryDirectory() as folder:
        rows = [paced(path.name, Path(folder)) for path in sorted((COURSE / "exercises").glob("[0-9]*"))]
    table(["a right submission", "simulated, s", "wall, s", "CPU, s", "times wall", "times CPU"], rows)


if __name__ == "__main__":
    main()
