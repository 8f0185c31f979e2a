"""The command line of bubblewrap: what confined processes see of this machine, and why it may fail."""

import importlib.util
import os
import shutil
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from grader.marking.errors import SandboxMissing
from grader.marking.sandbox.confinement import HOME
from grader.marking.sandbox.mounts import STAGE
from grader.workspace.interfaces import TOOLS
from sim.course_folders import ROS_PACKAGES

UNSAFE = "or mark with `--unsafe`, which lets students' code read and change all your files"
SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64")
SETTINGS = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "alternatives", "fonts")
USER = 1000

# Settings that forbid user namespaces: the file below /proc/sys, the value that does, and what undoes it.
SYSCTLS = (
    ("kernel/apparmor_restrict_unprivileged_userns", "1", "kernel.apparmor_restrict_unprivileged_userns=0"),
    ("kernel/unprivileged_userns_clone", "0", "kernel.unprivileged_userns_clone=1"),
    ("user/max_user_namespaces", "0", "user.max_user_namespaces=10000"),
)
# Ubuntu's profile: bubblewrap may make namespaces, and the processes that it starts may not.
PROFILE = "etc/apparmor.d/bwrap-userns-restrict"
MODULES = ROS_PACKAGES / "python"
PACKAGES = "sim", "grader", *sorted(file.parent.name for file in MODULES.glob("*/__init__.py"))


def visible_paths(extra: Sequence[Path]) -> list[str]:
    """Return the paths that can be read inside besides the system's: Python, all packages, and `extra`.

    Raises FileNotFoundError.
    """
    for path in extra:
        os.stat(path)
    python = map(Path, (sys.base_prefix, os.path.realpath(sys.base_prefix), sys.prefix))
    course = *_packages(), MODULES, TOOLS  # whole folders: a new interpreter lists them
    paths = {path.absolute() for path in (*python, *course, *extra)}
    system = {Path(path) for path in SYSTEM}
    hidden = [path for path in paths if not ({path, *path.parents} & system or paths & {*path.parents})]
    return sorted(map(str, hidden))


def _packages() -> list[Path]:
    specs: list[Any] = list(map(importlib.util.find_spec, PACKAGES))  # all of them are packages
    return [Path(spec.submodule_search_locations[0]) for spec in specs]


def _links(program: str) -> Iterator[tuple[str, str]]:
    """Yield the symbolic links from a program to its file, as pairs of target and link."""
    while os.path.islink(program):
        folder = os.path.realpath(os.path.dirname(program))
        to = os.path.normpath(os.path.join(folder, os.readlink(program)))
        yield to, program
        program = to


def environment(home: str, scratch: str, imports: Iterable[str]) -> dict[str, str]:
    """Return all environment variables of a confined process; none of the marker's own is passed on.

    imports: folders of modules besides Python's own and the course's.
    """
    modules = dict.fromkeys([*(str(package.parent) for package in _packages()), *imports])
    return {
        "HOME": home,
        "TMPDIR": scratch,
        "USER": "student",
        "PATH": f"{sys.prefix}/bin:/usr/bin:/bin",
        "LANG": "C.UTF-8",
        "PYTHONPATH": os.pathsep.join(modules),  # the same course as here, wherever it is installed
        "PYTHONHASHSEED": "0",
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "MALLOC_ARENA_MAX": "2",  # an arena takes 64 MB of address space, and each thread would have its own
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "MPLCONFIGDIR": f"{scratch}/matplotlib",
    }


def command(paths: Sequence[str], imports: Iterable[str], program: list[str]) -> list[str]:
    """Return the command that runs `program` inside. Raises SandboxMissing if there is no bubblewrap."""
    bwrap = shutil.which("bwrap")
    if not bwrap:
        raise SandboxMissing(
            "Marking runs students' code in a sandbox made by bubblewrap, and this machine has no `bwrap`: "
            f"install it with `sudo apt install bubblewrap`, {UNSAFE}."
        )
    arguments = [bwrap, "--as-pid-1", "--new-session", "--unshare-user", "--unshare-pid", "--unshare-ipc"]
    arguments += ["--unshare-net", "--unshare-uts", "--unshare-cgroup-try", "--hostname", "marking"]
    arguments += ["--uid", str(USER), "--gid", str(USER), "--cap-drop", "ALL", "--clearenv"]
    for name, value in environment(HOME, "/tmp", imports).items():
        arguments += ["--setenv", name, value]
    # Private folders come first: the course may be in /tmp.
    arguments += ["--proc", "/proc", "--dev", "/dev", "--tmpfs", "/tmp", "--dir", HOME, "--dir", STAGE]
    for path in SYSTEM:
        if os.path.islink(path):
            arguments += ["--symlink", os.readlink(path), path]
        elif os.path.exists(path):
            arguments += ["--ro-bind", path, path]
    for name in SETTINGS:
        arguments += ["--ro-bind-try", f"/etc/{name}", f"/etc/{name}"]
    for path in paths:
        arguments += ["--ro-bind", path, path]
    # Python may be started through a link outside these paths, such as one in ~/.local/bin.
    there = (*SYSTEM, *(f"/etc/{name}" for name in SETTINGS), *paths)
    for to, link in _links(program[0]):
        if not any(Path(link).is_relative_to(path) for path in there):
            arguments += ["--symlink", to, link]
    return [*arguments, "--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/", "--", *program]


def forbidden(message: str, root: Path = Path("/")) -> SandboxMissing:
    """Return the error for a system on which bubblewrap fails with this message."""
    undo = [
        f"`sudo sysctl {undo}`"
        for name, value, undo in SYSCTLS
        if (file := root / "proc/sys" / name).exists() and file.read_text().strip() == value
    ]
    if (root / PROFILE).exists():
        undo.append(f"`sudo apparmor_parser -R /{PROFILE}`")
    way = "In a container, allow user namespaces, as with `docker run --security-opt seccomp=unconfined`"
    if undo:
        way = f"Allow user namespaces with {' and '.join(undo)}"
    return SandboxMissing(f"This system doesn't let bubblewrap make a sandbox ({message}). {way}, {UNSAFE}.")
