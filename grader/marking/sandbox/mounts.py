"""Mounts the files that a confined process sees: all folders that it may write are on one small tmpfs."""

from pathlib import Path

from grader.marking.sandbox import linux
from grader.marking.sandbox.confinement import HOME, Confinement
from grader.marking.sandbox.resource_limits import MB

STAGE = "/scratch"  # the scratch file system is mounted here until its parts are bound to their paths
READ_ONLY = linux.MS_RDONLY | linux.MS_NOSUID | linux.MS_NODEV | linux.MS_NOEXEC  # as /proc is mounted
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/tty")
PRIVATE = {"tmp": "/tmp", "shm": "/dev/shm", "terminals": "/dev/pts", "processes": "/proc", "home": HOME}


def mount_all(confinement: Confinement) -> None:
    """Give this process a mount namespace whose writable folders are all on one small file system.

    Files that were opened before still belong to the others; `close_other_descriptors` closes them.
    """
    linux.unshare(linux.NEW_MOUNT)
    linux.mount("", "/", flags=linux.MS_REC | linux.MS_PRIVATE)
    most = confinement.limits
    options = f"mode=755,size={most.scratch_mb * MB},nr_inodes={most.scratch_files}"
    linux.mount("scratch", STAGE, "tmpfs", linux.MS_NOSUID | linux.MS_NODEV, options)
    scratch = Path(STAGE)
    for name in PRIVATE:
        (scratch / name).mkdir()
    _mount_own_process(scratch / "processes/self")
    for path in confinement.visible:
        for name, private in PRIVATE.items():
            if Path(path).is_relative_to(private):
                _bind(path, scratch / name / Path(path).relative_to(private))
    for name, private in PRIVATE.items():
        _bind(scratch / name, private)
    (scratch / "empty").mkdir()
    for path in confinement.hidden:
        _bind(scratch / "empty", path)
    linux.unmount(STAGE)
    for device in DEVICES:  # the machine's own: where root marks, a confined process could change their mode
        linux.mount("", device, flags=linux.MS_REMOUNT | linux.MS_BIND | linux.MS_RDONLY | linux.MS_NOSUID)


def _mount_own_process(target: Path) -> None:
    """Show this process itself in /proc, and no other one."""
    target.mkdir()
    linux.set_dumpable(True)  # else its own /proc/self would be closed to it
    linux.be_killed_first()
    _bind("/proc/self", target)
    # Read-only: otherwise a process that has used up the memory could have another one killed in its place.
    linux.mount("", str(target), flags=linux.MS_REMOUNT | linux.MS_BIND | READ_ONLY)


def _bind(source: str | Path, target: str | Path) -> None:
    target = Path(target)
    if Path(source).is_dir():
        target.mkdir(parents=True, exist_ok=True)
    elif not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        target.touch()
    linux.mount(str(source), str(target), flags=linux.MS_BIND | linux.MS_REC)
