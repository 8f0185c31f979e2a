"""Measures over a package's files: what it imports, declares and installs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from grader.checks.check import Missed
from grader.workspace.package import Package, PackageRun

ROS = re.compile(r"rclpy|tf2_ros|message_filters|launch(_ros)?|rosbag2_py|std_srvs|\w+_msgs|\w+_interfaces")
TESTS = ("test", "tests")


def package_of(run: PackageRun) -> Package:
    """Return the package of a run. Raises ValueError without one, which is the course's mistake."""
    if getattr(run, "package", None) is None:
        raise ValueError("this exercise has no package: give it one")
    return run.package


def names_what_it_imports(run: PackageRun) -> None:
    """Every package that modules and launch files import is in package.xml. Raises Missed."""
    package = package_of(run)
    imported = {
        name
        for path, data in package.sources.items()
        if path.endswith(".py") and path.split("/")[1] not in (*TESTS, "setup.py")
        for name in imports(data)
    }
    wanted = sorted({name.split(".")[0] for name in imported if ROS.fullmatch(name.split(".")[0])})
    left_out = [name for name in wanted if name not in package.package_xml.needs]
    if left_out:
        raise Missed(
            f"<depend> or <exec_depend> for each of {', '.join(wanted)} in package.xml",
            f"none for {', '.join(left_out)}",
            "Anyone who installs your package gets only what package.xml names. Here all of ROS is "
            f"installed, so it runs anyway. Add <depend>{left_out[0]}</depend>.",
        )


def installs_by_itself(run: PackageRun) -> None:
    """setup.py installs what colcon would otherwise add. Raises Missed."""
    name = package_of(run).package_xml.name
    pairs = {
        "marker": f"('share/ament_index/resource_index/packages', ['resource/{name}'])",
        "package.xml": f"('share/{name}', ['package.xml'])",
    }
    for line in package_of(run).built.output.splitlines():
        if "explicitly install" in line:
            what = next((what for what in pairs if what in line), "package.xml")
            raise Missed(
                f"{pairs[what]} in data_files",
                f"none: colcon installed it instead, and warns that it won't always ({what})",
                "Add this pair to data_files in setup.py, with a comma after it.",
            )


def imports(data: bytes) -> Iterator[str]:
    """Yield the full names of what a module imports; `.name` for a module of the same package."""
    for node in ast.walk(parsed(data)):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            yield module
            yield from (f"{module.rstrip('.')}.{name.name}" for name in node.names)


def parsed(data: bytes) -> ast.Module:
    """Return the code of a module; an empty one if it can't be parsed."""
    try:
        return ast.parse(data)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.Module([], [])
