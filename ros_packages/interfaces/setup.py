"""One wheel from sensor_msgs_py and all packages under definitions/, for every Python from 3.11 on."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
PACKAGES = sorted(path.name for path in (HERE / "definitions").iterdir())


class BuildInterfaces(build_ext):
    """Builds each package with build_tools and adds its files to the wheel."""

    def run(self) -> None:
        """Build all packages; their share/ goes where the ROS wheels put theirs."""
        output = Path(self.build_temp).resolve()
        shutil.rmtree(output, ignore_errors=True)
        output.mkdir(parents=True)
        # A separate process, because only a fixed hash seed makes builds reproducible.
        command = [sys.executable, "-m", "build_tools", "definitions", str(output)]
        done = subprocess.run(command, cwd=HERE, env={**os.environ, "PYTHONHASHSEED": "0"}, check=False)
        if done.returncode:
            raise SystemExit(done.returncode)
        for file in sorted(output.glob("python/**/*.*")):
            if file.suffix in (".py", ".so"):
                target = Path(self.build_lib, file.relative_to(output / "python"))
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file, target)
        shared: dict[str, list[str]] = {}
        for file in sorted(file for file in output.glob("share/**/*") if file.is_file()):
            shared.setdefault(str(file.parent.relative_to(output)), []).append(str(file))
        self.distribution.data_files = sorted(shared.items())


class WheelWithBuildNumber(bdist_wheel):
    """A wheel whose share/ is found in spite of its build number."""

    def finalize_options(self) -> None:
        """Take the number out of the folder's name, where setuptools leaves it and pip doesn't expect it."""
        super().finalize_options()
        self.data_dir = self.data_dir.replace(f"-{self.build_number}.data", ".data")


setup(
    packages=["sensor_msgs_py"],
    ext_modules=[Extension(package, [], py_limited_api=True) for package in PACKAGES],
    cmdclass={"build_ext": BuildInterfaces, "bdist_wheel": WheelWithBuildNumber},
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
