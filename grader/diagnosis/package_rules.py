"""What goes wrong where a package's program is looked for and begins, as `rules` has rclpy's exceptions."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePosixPath

from grader.diagnosis.rules import Rule
from sim.evidence import CallbackError, Recording
from sim.ros.packages import packages
from sim.ros.workspaces import sources_of

BUILD_AGAIN = "If it is newer than the last build, run colcon build again."

PACKAGE_RULES = (
    Rule(
        "ExecutableNotFound", r"installed into bin",
        "Fix setup.cfg: [develop] has script_dir, [install] has install_scripts, both $base/lib/ and the "
        "package's name.",
    ),
    Rule(
        "ExecutableNotFound", r"",
        "A command is a name in 'console_scripts' of setup.py: 'NAME = PACKAGE.MODULE:FUNCTION'. Check each "
        "letter of NAME.",
    ),
    Rule(
        "RCLInvalidROSArgsError", r"Couldn't parse params file",
        "A parameter file begins with a node's name, or /**. Indented below it is ros__parameters, with two "
        "underscores; one level deeper are the names with their values.",
    ),
    Rule(
        "ModuleNotFoundError", r"^No module named '([\w.]+)\.py'",
        "Imports and entry points name a module without the .py of its file: `{0}`.",
    ),
    Rule(
        "SubstitutionFailure", r"^executable '(\S+)' not found on the libexec",
        "A Node of the launch file has executable={0!r}. It has to be a command of the package: a name in "
        "'console_scripts' of its setup.py.",
    ),
    Rule(
        "NoLaunchFile", r"file '([^']+)' was not found",
        "{0} was not installed. In setup.py, data_files needs ('share/' + package_name + '/launch', "
        "glob('launch/*')).",
    ),
)  # fmt: skip


def launch_file_advice(error: CallbackError) -> str:
    """Return what to do about a name in a launch file that names no program of the student's; else ""."""
    lost = re.match(r"Can not find attribute '(\w+)' in Entity '(\w+)'", error.text)
    if error.type == "AttributeError" and lost:
        return f"`{lost[2]}` needs `{lost[1]}`, on the line of the launch file that the error names."
    if error.type != "ExecutableNotFound" or re.search(r"setup\.py|into bin|not a Python", error.text):
        return ""
    if "CMakeLists.txt" in error.text:
        return (
            "A program of a package with a CMakeLists.txt is a file in install(PROGRAMS ... DESTINATION "
            "lib/PACKAGE). Check each letter of its name, .py included."
        )
    typo = re.search(r"but no (\S+)\. Did you mean (\S+)\?", error.text)
    if typo:
        return f"Write `{typo[2]}` in the place of `{typo[1]}`."
    return "The course has no such program. Its error says what to use in its place."


def own_module(error: CallbackError, recording: Recording) -> str:
    """Return what to do if a package's program lacks a module or function that the package has; else ""."""
    sources = getattr(getattr(recording, "package", None), "sources", {})
    lost = re.match(r"module '(\w+)\.([\w.]+)' has no attribute '(\w+)'", error.text)
    if error.type == "AttributeError" and lost and f"{lost[1]}/{lost[1]}/__init__.py" in sources:
        return (
            f"{lost[1]}.{lost[2]} has no {lost[3]}. Is it an entry point in "
            "setup.py? After its `:` comes the function that starts the program."
        )
    if error.type == "TypeError" and error.text == "'module' object is not callable" and sources:
        return (
            "Is it an entry point without a function in setup.py? After the `:` comes the function that "
            "starts the program, as in 'hello = greeter.hello:main'."
        )
    found = re.match(r"No module named '([\w.]+)'", error.text)
    if error.type != "ModuleNotFoundError" or not found:
        return ""
    package = found[1].partition(".")[0]
    if not sources and package in packages():  # built and sourced
        return _unfound_module(found[1], sources_of(package), f" {BUILD_AGAIN}")
    return _unfound_module(found[1], sources)


def _unfound_module(name: str, sources: Mapping[str, bytes], if_new: str = "") -> str:
    """Return what to do where no module has this name, and a file of the package could be it; else "".

    if_new: what to do about a file that may be newer than the last build.
    """
    outside = ""
    for path in map(PurePosixPath, sources):
        top, (package, *between) = path.parts[0], path.parts[1:-1] or [""]
        if path.suffix != ".py" or not package:
            continue
        whole = ".".join([package, *between, *([] if path.stem == "__init__" else [path.stem])])
        if f"{whole}.".startswith(f"{name}.") and (package == top or name == package):
            return _not_installed(path, sources, if_new)
        if name == path.stem and package == top:
            return (
                "The full name of a package's module begins with the package's name, in imports and in entry "
                f"points: write {whole}, not {name}."
            )
        if package != top and name in (path.stem, f"{top}.{path.stem}"):
            outside = (
                f"{path.relative_to(top)} is outside the package for Python. Move it into the "
                f"folder {top}/ that has __init__.py."
            )
    return outside


def _not_installed(path: PurePosixPath, sources: Mapping[str, bytes], if_new: str) -> str:
    """Return what to do about a module of a package that was left out of its build."""
    top = path.parts[0]
    folders = [folder for folder in path.parents if len(folder.parts) > 1]
    bare = [folder for folder in folders if f"{folder}/__init__.py" not in sources]
    if bare:
        return (
            f"{bare[-1].relative_to(top)} has no __init__.py, so its modules are not installed: add an empty "
            "file of that name, and build again."
        )
    begin = f"{path.relative_to(top)} was not installed."
    rules = b"".join(sources.get(f"{top}/{name}", b"") for name in ("setup.py", "CMakeLists.txt"))
    if if_new and re.search(rb"find_packages\(|ament_python_install_package\(", rules):
        return begin + if_new
    if f"{top}/CMakeLists.txt" in sources:
        return (
            f"{begin} In CMakeLists.txt, ament_python_install_package(${{PROJECT_NAME}}) installs the folder "
            f"{top}/, after find_package(ament_cmake_python REQUIRED)."
        )
    return (
        f"{begin} In setup.py, packages=find_packages(exclude=['test']) finds each folder that has an "
        "__init__.py."
    )


def absent_launch_file(error: CallbackError) -> str:
    """Return what to do where a launch file or its package is not found, and the error says why."""
    if error.type != "NoLaunchFile":
        return ""
    near = re.search(r"[Dd]id you mean '?([\w.]+)'?\?$", error.text)
    if near:
        return f"Is the name misspelled? Write {near[1]}."
    if error.text.startswith("There is no launch file"):
        return "The path is relative to the folder that is named; `ls` shows what is there."
    return ""
