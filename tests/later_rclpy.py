"""Later releases of rclpy for Jazzy: whether a run takes their Python files, and recordings stay equal.

python -m tests.later_rclpy CHECKOUT ...    sources of releases of rclpy, each with rclpy/ and package.xml

Their Python files are laid over a copy of the installed rclpy, whose compiled layer stays as it is: the
exceptions that it lacks are listed, and never raised. It ends with 1 when a run refuses a release, or when
recordings differ. Nothing is fetched.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from tests.bench.report import table
from tests.patience import PATIENCE

ROOT = Path(__file__).parents[1]
COMPILED = "rclpy._rclpy_pybind11"


Found = dict[str, Any]


def scenarios() -> Found:
    """What this process' rclpy lacks, how a run refuses it, and each scenario's digest and first error."""
    found: Found = {"lacking": [], "refused": "", "digests": [], "errors": []}
    _import_compiled_layer(found["lacking"])
    try:
        from tests.sim.ros import programs  # only here: the hooks come with it
    except ImportError as error:
        return found | {"refused": f"{type(error).__name__}: {error}"}
    for recording in programs.scenarios():
        found["digests"].append(recording.digest)
        found["errors"].append(next((f"{error.type}: {error.text}" for error in recording.errors), ""))
    return found


def _import_compiled_layer(lacking: list[str]) -> None:
    """Import it before rclpy does: it then has each exception that is asked for, and adds to `lacking`."""
    (folder,) = importlib.util.find_spec("rclpy").submodule_search_locations
    (file,) = Path(folder).glob("_rclpy_pybind11.*.so")
    spec = importlib.util.spec_from_file_location(COMPILED, file)
    module = sys.modules[COMPILED] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)

    def stand_in(name: str) -> type[Exception]:
        if not name.endswith("Error"):
            raise AttributeError(f"module {COMPILED!r} has no attribute {name!r}")
        lacking.append(name)
        setattr(module, name, type(name, (RuntimeError,), {}))
        return getattr(module, name)

    module.__getattr__ = stand_in


def look_at(checkout: Path | None) -> Found:
    """What `scenarios` finds with the Python files of a checkout; None: with the installed ones."""
    installed = Path(importlib.util.find_spec("rclpy").submodule_search_locations[0])
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(installed, Path(folder, "rclpy"), ignore=shutil.ignore_patterns("__pycache__"))
        for libraries in installed.parent.glob("*rclpy.libs"):  # which the compiled layer looks for beside it
            Path(folder, libraries.name).symlink_to(libraries)
        if checkout is not None:
            shutil.copytree(checkout / "rclpy", Path(folder, "rclpy"), dirs_exist_ok=True)
        environment = os.environ | {"PYTHONPATH": os.pathsep.join([folder, str(ROOT)]), "PYTHONHASHSEED": "0"}
        command = [sys.executable, "-m", "tests.later_rclpy", "--here"]
        quiet = {"capture_output": True, "text": True, "timeout": PATIENCE, "check": False}
        done = subprocess.run(command, cwd=folder, env=environment, **quiet)
        if done.returncode:
            raise RuntimeError(done.stderr.strip()[-500:])
        return json.loads(done.stdout.splitlines()[-1])


def main() -> int:
    """Print a row for each checkout, and what a run says of those that it refuses."""
    parser = argparse.ArgumentParser("python -m tests.later_rclpy", description=__doc__.splitlines()[0])
    parser.add_argument("checkouts", type=Path, nargs="+", help="of rclpy, one for each release")
    checkouts = parser.parse_args().checkouts
    for folder in checkouts:
        if not (folder / "rclpy" / "executors.py").is_file():
            parser.error(f"{folder} is no checkout of rclpy: it has no rclpy/executors.py")
    usual = look_at(None)["digests"]
    rows, notes = [], []
    for folder in checkouts:
        (release,) = re.findall(r"<version>(.+)</version>", (folder / "package.xml").read_text("utf-8"))
        found = look_at(folder)
        equal = list(map(str.__eq__, found["digests"], usual))
        rows.append([release, f"{sum(equal)} of {len(usual)}", ", ".join(found["lacking"]) or "-"])
        first = next((e for e, same in zip(found["errors"], equal, strict=True) if e and not same), "")
        notes += [f"{release}: {words}" for words in (found["refused"], first) if words]
    table(["rclpy", "equal recordings", "missing in the compiled layer"], rows)
    print(*notes, sep="\n")
    return int(any(row[1] != f"{len(usual)} of {len(usual)}" for row in rows))


if __name__ == "__main__":
    if sys.argv[1:] == ["--here"]:
        print(json.dumps(scenarios()))
    else:
        sys.exit(main())
