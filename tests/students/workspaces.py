"""Workspaces of students: what they wrote, as text, laid out in a folder when someone looks."""

from __future__ import annotations

import atexit
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

SETUP = """\
from glob import glob

from setuptools import find_packages, setup

setup(
    name='{name}',
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/{name}']),
        ('share/{name}', ['package.xml']),
        ('share/{name}/launch', glob('launch/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={{'console_scripts': [{points}]}},
)
"""
CFG = "[develop]\nscript_dir=$base/lib/{name}\n[install]\ninstall_scripts=$base/lib/{name}\n"
XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>A package of a test</description>
  <maintainer email="you@example.org">you</maintainer>
  <license>Apache-2.0</license>
{needs}
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""


class Workspace:
    """A workspace with one package, as a path: it is written when it is asked for.

    module: whose it is, for tests that look for what a module defines.
    """

    def __init__(self, module: str, files: Mapping[str, str | bytes]) -> None:
        self.__module__ = module
        self.files = dict(files)

    def __fspath__(self) -> str:
        folder = Path(tempfile.mkdtemp(prefix="students-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        for path, text in self.files.items():
            file = folder / "src" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return str(folder)


def package(name: str, points: str, needs: str, modules: Mapping[str, str]) -> dict[str, str]:
    """The files of a right package: entry points as in setup.py, needs by space, modules by file name."""
    listed = "\n".join(f"  <depend>{need}</depend>" for need in needs.split())
    return {
        f"{name}/package.xml": XML.format(name=name, needs=listed),
        f"{name}/setup.py": SETUP.format(name=name, points=points),
        f"{name}/setup.cfg": CFG.format(name=name),
        f"{name}/resource/{name}": "",
        f"{name}/{name}/__init__.py": "",
        **{f"{name}/{path}": text for path, text in modules.items()},
    }


def changed(files: Mapping[str, str], path: str, old: str = "", new: str | None = None) -> dict[str, str]:
    """The files with another text in one of them; without `old` a new text, without both no such file."""
    made = dict(files)
    if new is None:
        del made[path]
        return made
    if old:
        assert old in made[path], f"{path} has no {old}"
        made[path] = made[path].replace(old, new)
        return made
    made[path] = new
    return made
