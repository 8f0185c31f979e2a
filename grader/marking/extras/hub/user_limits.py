"""What one user of a hub can use: memory, processes and CPU time, by control groups.

A server joins the group of its user before it runs as that user, and all that it starts is in it. Of the two
versions of Linux's control groups the second is preferred; containers often have the first.
"""
import os
import resource
import signal
from contextlib import suppress
from pathlib import Path

from grader.marking.extras.hub.hub_settings import UserLimits

ROOT = Path("/sys/fs/cgroup")
NAME = "ros2-hub"
CONTROLLERS = ("memory", "pids", "cpu")
PERIOD = 100_000  # microseconds in which a group gets its share of CPU time
GIGABYTE = 10**9


def missing_controllers(root: Path = ROOT) -> list[str]:
    """The controllers that this machine lets no user have."""
    if _is_unified(root):
        present = (root / "cgroup.controllers").read_text(encoding="utf-8").split()
        return [name for name in CONTROLLERS if name not in present or not _enable(root, name)]
    return [name for name in CONTROLLERS if not os.access(root / name / "cgroup.procs", os.W_OK)]


def make_group(user: str, limits: UserLimits, root: Path = ROOT) -> list[Path]:
    """Make the group of a user, or change its limits; returns the files in which processes join it."""
    lacking = missing_controllers(root)
    if _is_unified(root):
        return [] if lacking else [_unified(user, limits, root)]
    return [_separate(root / name / NAME / user, name, limits) for name in CONTROLLERS if name not in lacking]


def end_group(user: str, root: Path = ROOT) -> None:
    """Kill what the user left running, and remove the group."""
    tops = [root] if _is_unified(root) else [root / name for name in CONTROLLERS]
    places = [top / NAME / user for top in tops]
    for place in places:
        with suppress(OSError):
            for process in (place / "cgroup.procs").read_text(encoding="utf-8").split():
                with suppress(ProcessLookupError):
                    os.kill(int(process), signal.SIGKILL)
            place.rmdir()  # fails while one is ending; the next server of the user has the same group


def join(files: list[Path], limits: UserLimits) -> None:
    """Put this process into a user's group, as root, before it becomes that user."""
    for file in files:
        file.write_text("0")
    # Where there is no controller for it, Linux counts a user's processes itself.
    resource.setrlimit(resource.RLIMIT_NPROC, (limits.processes, limits.processes))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _is_unified(root: Path) -> bool:
    return (root / "cgroup.controllers").exists()


def _enable(folder: Path, controller: str) -> bool:
    """Let the groups in this one have a controller; a container may have it and forbid that."""
    try:
        (folder / "cgroup.subtree_control").write_text(f"+{controller}")
        return True
    except OSError:
        return False


def _unified(user: str, limits: UserLimits, root: Path) -> Path:
    group = root / NAME / user
    (root / NAME).mkdir(exist_ok=True)
    for name in CONTROLLERS:
        _enable(root / NAME, name)
    group.mkdir(exist_ok=True)
    (group / "memory.max").write_text(str(int(limits.memory_gb * GIGABYTE)))
    with suppress(OSError):  # without swap
        (group / "memory.swap.max").write_text("0")
    (group / "pids.max").write_text(str(limits.processes))
    (group / "cpu.max").write_text(f"{int(limits.cpus * PERIOD)} {PERIOD}")
    return group / "cgroup.procs"


def _separate(group: Path, controller: str, limits: UserLimits) -> Path:
    group.mkdir(parents=True, exist_ok=True)
    if controller == "memory":
        (group / "memory.limit_in_bytes").write_text(str(int(limits.memory_gb * GIGABYTE)))
    elif controller == "pids":
        (group / "pids.max").write_text(str(limits.processes))
    else:
        (group / "cpu.cfs_period_us").write_text(str(PERIOD))
        (group / "cpu.cfs_quota_us").write_text(str(int(limits.cpus * PERIOD)))
    return group / "cgroup.procs"
