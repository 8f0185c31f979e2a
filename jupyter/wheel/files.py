"""Adds to the wheel what isn't Python: lessons, exercises and all else that students get, in ros2_course/."""

import shutil
from pathlib import Path

from setuptools.command.build_py import build_py

FOLDER = "ros2_course"
FILES = ("AGENTS.md", "LICENSE", "TUTOR.md", "nbgrader_config.py", "requirements.lock")
FOLDERS = ("course", "exercises", "jupyter", "ros_packages")
BUILDING = shutil.ignore_patterns("wheel")  # this folder
# The packages that PyPI lacks of ROS are on the path, behind those of a ROS installation.
PTH = f"{FOLDER}/ros_packages/python\n"


class BuildWithFiles(build_py):
    """Builds the packages; of a wheel also the files beside them. `make wheels` calls it in the handout."""

    def run(self) -> None:
        """Copy everything to where the wheel is made of."""
        super().run()
        if self.editable_mode:
            return
        target = Path(self.build_lib, FOLDER)
        target.mkdir(parents=True, exist_ok=True)
        for name in FILES:
            shutil.copyfile(name, target / name)
        for name in FOLDERS:
            shutil.copytree(name, target / name, dirs_exist_ok=True, ignore=BUILDING)
        Path(self.build_lib, f"{FOLDER}.pth").write_text(PTH, encoding="utf-8")
