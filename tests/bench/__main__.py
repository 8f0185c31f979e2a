"""All benchmarks, each in a process of its own: python -m tests.bench [NAME ...]"""

import importlib
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

from sim.distro import RCLPY_DISTRIBUTION

PARTS = (
    "scenario",
    "startup",
    "world",
    "transforms",
    "repeats",
    "digests",
    "marking",
    "pace",
    "view",
)
# hub installs what it needs; the others take minutes
ON_REQUEST = ("navigator", "localized", "capstone", "hub")


def machine() -> str:
    """What it all ran on."""
    model = [line for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    processor = model[0].split(":")[1].strip() if model else platform.machine()
    rclpy = version(RCLPY_DISTRIBUTION)
    return f"{processor}, {len(model)} cores; Python {platform.python_version()}, rclpy {rclpy}"


def main(names: list[str]) -> int:
    """Run some or all; the exit status says whether one failed."""
    known = PARTS + ON_REQUEST
    unknown = [name for name in names if name not in known]
    if unknown:
        print(f"There is no benchmark {unknown[0]!r}; the benchmarks are {', '.join(known)}.")
        return 2
    print(machine())
    failed = 0
    for name in names or PARTS:
        module = f"tests.bench.{name}"
        print(f"\n== {name}: {importlib.import_module(module).__doc__.splitlines()[0]}\n", flush=True)
        failed |= subprocess.run([sys.executable, "-m", module]).returncode
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
