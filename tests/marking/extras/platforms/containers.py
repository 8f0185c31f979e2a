"""Root file systems like those of the platforms' containers, in which an autograder is installed and run.

Each is Debian with Python, made by mmdebstrap, and the autograder lies where the platform puts it. It runs as
in a container: in namespaces of its own, with the capabilities and the filter of system calls that Docker's
usual settings give. It needs root and takes minutes, so only soak tests and gradescope_trial.py use it.
"""
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

BUILDS = ("setuptools", "wheel")  # one package has no wheel, and is built of its source, without a compiler
INCLUDED = "python3,python3-venv,ca-certificates,sudo"
CLEAN = ("env", "-i", "PATH=/usr/local/bin:/usr/bin:/bin", "LANG=C.UTF-8", "PIP_NO_INDEX=1")
# $1: the root file system. What is mounted here disappears with the namespace.
MOUNTED = """
set -e
mount --bind "$1" "$1"
mount -t proc proc "$1/proc"
mount --rbind /dev "$1/dev"
ip link set lo up 2>/dev/null || true
shift
exec "$@"
"""
NAMESPACES = ("unshare", "--mount", "--propagation", "private", "--pid", "--fork", "--kill-child", "--net")
DOCKER_LIKE = (sys.executable, "-m", "tests.marking.sandbox.docker_like")


def missing() -> str:
    """Return what this machine lacks to make such a root file system; "" if nothing."""
    if os.geteuid() != 0:
        return "only root can make a root file system"
    lacking = [name for name in ("mmdebstrap", "unshare", "chroot") if shutil.which(name) is None]
    return f"this machine has no {lacking[0]}" if lacking else ""


def make_root(root: Path) -> Path:
    """Make a root file system with nothing of the course, unless it was made before."""
    if (root / "usr" / "bin" / "python3").exists():
        return root
    options = ("--variant=minbase", "--quiet", f"--include={INCLUDED}", "bookworm")
    subprocess.run(["mmdebstrap", *options, str(root)], check=True)
    return root


def put_bundle(bundle: Path, place: Path) -> None:
    """Put an autograder, a folder or a ZIP, into `place`, with the wheels of all that it needs.

    A platform's container gets these from PyPI while it is set up; here it has no network.
    """
    shutil.rmtree(place, ignore_errors=True)
    if bundle.is_dir():
        shutil.copytree(bundle, place)
    else:
        with zipfile.ZipFile(bundle) as archive:
            for entry in archive.infolist():
                target = Path(archive.extract(entry, place))
                target.chmod(entry.external_attr >> 16 & 0o777)
    for needed in (["--requirement", str(place / "requirements.txt")], BUILDS):
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", *needed]
        subprocess.run([*command, "--dest", str(place / "wheels")], check=True, stderr=subprocess.DEVNULL)


def run(
    root: Path, *command: str, contained: bool = True, timeout: float = 1800, **variables: str
) -> subprocess.CompletedProcess[str]:
    """Run a command there, as root. contained: as in a container of Docker's, or else as on a machine.

    variables: of its environment. It has no network.
    """
    given = [f"{name}={value}" for name, value in variables.items()]
    inside = [*(DOCKER_LIKE if contained else ()), "chroot", str(root), *CLEAN, *given, *command]
    whole = [*NAMESPACES, "sh", "-c", MOUNTED, "sh", str(root), *inside]
    return subprocess.run(whole, capture_output=True, text=True, check=False, timeout=timeout)


def lay_out(folder: Path, *subfolders: str) -> None:
    """Make folders anew, which are empty."""
    for name in subfolders:
        shutil.rmtree(folder / name, ignore_errors=True)
        (folder / name).mkdir(parents=True)
