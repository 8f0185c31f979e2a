"""Students on a real hub at the same time: each runs lesson 2, plays for a minute, validates and submits.

python -m tests.bench.hub [STUDENTS]: needs root, npm and a C compiler, as `make hub` does.
"""

import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from grader.marking.extras.hub.user_limits import NAME, ROOT
from tests.bench.report import table
from tests.marking.extras.hub.hub_client import HubClient, KernelClient
from tests.marking.extras.hub.real_hub import COURSE, RealHub, real_hub, reason_to_skip

ASSIGNMENT = "02_topics"
LESSON, NOTEBOOK = f"course/{ASSIGNMENT}/lesson.ipynb", f"exercises/{ASSIGNMENT}/topics.ipynb"
PLAYED = 60  # s
LINUX = 500  # MB that the system itself needs
PLAY = f"""
import asyncio
from sim import play
player = play(world="room", seconds=1000)
begin = player.recording.stamp
await asyncio.sleep({PLAYED})
print("", player.recording.stamp - begin)
player.stop()
"""


@dataclass
class StudentDay:
    """What one student saw; all times in s."""

    login: float = 0.0
    cells: list[float] = field(default_factory=list)
    frames: float = 0.0  # each second
    pace: float = 0.0  # simulated seconds of `play` in each second
    validated: float = 0.0
    done: float = 0.0
    lesson_megabytes: float = 0.0  # server and the lesson's kernel
    megabytes: float = 0.0  # the assignment's kernel, too
    failures: list[str] = field(default_factory=list)


def used_megabytes(user: str) -> float:
    """The memory of all processes of a user, as their control group counts it, without the file cache."""
    for folder, name in ((ROOT / "memory" / NAME / user, "total_rss"), (ROOT / NAME / user, "anon")):
        if (folder / "memory.stat").exists():
            rows = dict(line.split() for line in (folder / "memory.stat").read_text().splitlines())
            return int(rows[name]) / 1e6
    return float("nan")


def run_notebook(kernel: KernelClient, notebook: dict[str, Any], day: StudentDay) -> list[float]:
    """Run all cells, those that raise on purpose included; returns the seconds of each."""
    seconds = []
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code" and cell["source"].strip():
            result = kernel.run(cell["source"])
            seconds.append(result["seconds"])
            if result["status"] != "ok" and "raises-exception" not in cell["metadata"].get("tags", []):
                day.failures.append(f"{cell['id']}: {result['status']} {result['text'][-300:]}")
    return seconds


def spend_day(hub: RealHub, user: str, day: StudentDay) -> None:
    """Log in, run the lesson, play, validate in a new kernel as the button does, and submit."""
    begin = time.monotonic()
    client = HubClient(hub.address, user, hub.passwords[user])
    client.start_server()
    day.login = time.monotonic() - begin
    kernel = client.start_kernel(LESSON)
    day.cells = run_notebook(kernel, client.read_notebook(LESSON), day)
    played = kernel.run(PLAY)
    day.frames, day.pace = played["comms"] / PLAYED, float(played["text"].split()[-1]) / PLAYED
    validation, day.lesson_megabytes = time.monotonic(), used_megabytes(user)
    second = client.start_kernel(NOTEBOOK)
    run_notebook(second, client.read_notebook(NOTEBOOK), day)
    day.validated, day.megabytes = time.monotonic() - validation, used_megabytes(user)
    second.stop()
    if not client.submit(COURSE, ASSIGNMENT)["success"]:
        day.failures.append("not submitted")
    kernel.stop()
    day.done = time.monotonic() - begin


def safely(hub: RealHub, user: str) -> StudentDay:
    """Return the day of a student; what fails ends it and is reported."""
    day = StudentDay()
    try:
        spend_day(hub, user, day)
    except Exception as error:
        day.failures.append(f"{type(error).__name__}: {str(error)[:300]}")
    return day


def spread(values: Sequence[float], digits: int = 1) -> str:
    """Median, that below which 95 % are, and the largest."""
    ordered = sorted(values)
    picked = statistics.median(ordered), ordered[int(0.95 * (len(ordered) - 1))], ordered[-1]
    return ", ".join(f"{value:.{digits}f}" for value in picked)


def own_megabytes(hub: RealHub) -> float:
    """The memory of the hub, its proxy and the course's server."""
    listed = subprocess.run(["ps", "-eo", "rss,args"], capture_output=True, text=True, check=True).stdout
    others = "singleuser", "ipykernel"
    mine = [line for line in listed.splitlines() if str(hub.settings.folder) in line]
    return sum(int(line.split()[0]) for line in mine if not any(word in line for word in others)) / 1e3


def capacity(gigabytes: int, own: float, days: Sequence[StudentDay]) -> str:
    """How many students this memory is enough for, by the medians."""
    left = 1000 * gigabytes - LINUX - own
    lesson = statistics.median([day.lesson_megabytes for day in days])
    both = statistics.median([day.megabytes for day in days])
    return f"{left / lesson:.0f}, {left / both:.0f}"


def main(students: int = 8) -> int:
    """Print what all of them saw; returns the exit status."""
    if reason := reason_to_skip():
        print(f"Not measured: {reason}.")
        return 1
    with real_hub(students) as hub:
        hub.as_grader("nbgrader", "release_assignment", ASSIGNMENT)
        load, before, begin = os.getloadavg()[0], os.times(), time.monotonic()
        with ThreadPoolExecutor(students) as pool:
            days = list(pool.map(lambda user: safely(hub, user), hub.settings.students))
        seconds, after, own = time.monotonic() - begin, os.times(), own_megabytes(hub)
    complete = [day for day in days if day.done] or days
    rows = [
        ["students; all of them done after (s)", f"{students}; {seconds:.0f}"],
        ["log in and start the server (s)*", spread([day.login for day in complete])],
        ["a cell of the lesson (s)*", spread([second for day in complete for second in day.cells], 2)],
        ["frames of `play` received each second*", spread([day.frames for day in complete])],
        ["simulated seconds of `play` each second*", spread([day.pace for day in complete], 2)],
        ["validate an exercise notebook (s)*", spread([day.validated for day in complete])],
        ["from the login to the submission (s)*", spread([day.done for day in complete])],
        ["memory of a student: the lesson open (MB)*", spread([day.lesson_megabytes for day in complete], 0)],
        ["memory of a student: the assignment, too (MB)*", spread([day.megabytes for day in complete], 0)],
        ["memory of the hub, the proxy and the course's server (MB)", f"{own:.0f}"],
        *([f"students on {gigabytes} GB: with the lesson, with both", capacity(gigabytes, own, complete)]
          for gigabytes in (4, 24)),
        ["computing time of the simulated browsers (s)", f"{sum(after[:2]) - sum(before[:2]):.0f}"],
        ["load of the machine before; its cores", f"{load:.1f}; {os.cpu_count()}"],
        ["failures; students who didn't get to the end", f"{sum(len(day.failures) for day in days)}; "
         f"{sum(not day.done for day in days)}"],
    ]
    table(["* median, 95 % at most, all at most", ""], rows)
    failures = [f"student {number}: {failure}" for number, day in enumerate(days) for failure in day.failures]
    print(json.dumps(failures[:10], indent=1) if failures else "")
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
