"""How fast marks come: simulated seconds that are judged in each wall second, for every assignment."""

import shutil
import tempfile
import time
from pathlib import Path

from grader.marking.office.cli import USUAL_JOBS
from grader.marking.plan import Task
from grader.marking.pool import Pool
from tests.bench.report import table

STUDENTS = 8
COURSE = Path.cwd()


def paced(assignment: str, folder: Path) -> list[object]:
    """Mark right submissions of so many students in their cages; a line of the table."""
    shutil.copytree(COURSE / "solutions" / assignment, folder / assignment)
    released = COURSE / "exercises" / assignment
    tasks = [
        Task(f"student_{number}", assignment, folder / assignment, released, "0" * 64)
        for number in range(STUDENTS)
    ]
    began = time.perf_counter()
    with Pool(COURSE, USUAL_JOBS, secret="a secret") as pool:
        results = list(pool.mark(tasks))
    wall = time.perf_counter() - began
    if {result.points for result in results} != {100.0}:
        raise RuntimeError(f"the solutions of {assignment} did not get all points")
    judged = sum(result.timings["judged"] for result in results)
    return [assignment, f"{judged / STUDENTS:.0f}", f"{wall / STUDENTS:.2f}", f"{judged / wall:.0f}"]


def main() -> None:
    """All assignments, one after the other."""
    with tempfile.TemporaryDirectory() as folder:
        rows = [paced(path.name, Path(folder)) for path in sorted((COURSE / "exercises").glob("[0-9]*"))]
    table(["a right submission", "simulated, s", "wall, s", "times real time"], rows)


if __name__ == "__main__":
    main()
