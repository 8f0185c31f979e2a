"""Measures over a package's files: what it imports, declares and installs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from grader.checks.check import Missed
from grader.workspace.building import CUT, OUTPUT_BYTES
from grader.workspace.package import Package, PackageRun
from sim.evidence import INFRASTRUCTURE_TOPICS, is_node_service

ROS = re.compile(r"rclpy|tf2_ros|message_filters|launch(_ros)?|rosbag2_py|std_srvs|\w+_msgs|\w+_interfaces")
TESTS = ("test", "tests")
IMPORTING = {"importlib", "import_module", "__import__", "exec", "eval", "runpy", "pkgutil"}
IN_SETUP = {"setuptools", "glob", "os", "pathlib"}  # what a setup.py may import
OF_OS = {"path", "listdir", "walk", "sep"}  # and of `os`
HIDES = {*IMPORTING, "vars", "globals", "getattr", "__dict__", "__builtins__"}
CHANGING = {*IMPORTING, "vars", "__dict__", "addsitedir"}  # finds modules in other folders
OF_EVERY_NODE = {*INFRASTRUCTURE_TOPICS, "/tf", "/tf_static"}
WARNING = re.compile(r"\b\w*Warning: (.+)")  # a line of Python's warnings
MODULES = re.compile(r"lib/python[^/]+/site-packages/(.+)")


def package_of(run: PackageRun) -> Package:
    """Return the package of a run. Raises ValueError without one, which is the course's mistake."""
    package: Package | None = getattr(run, "package", None)
    if package is None:
        raise ValueError("this exercise has no package: give it one")
    return package


def starts_a_node(run: PackageRun) -> None:
    """A program of the package runs a node, unless an error explains why none does. Raises Missed."""
    if not run.errors and run.course_nodes.issuperset(run.graph.nodes):
        raise Missed("a program that runs a node", "no node", "What files say counts once a program runs.")


def names_what_it_imports(run: PackageRun) -> None:
    """Every package that modules and launch files import is in package.xml. Raises Missed.

    If a module imports by a function or executes text, what its nodes use counts as imported.
    """
    package = package_of(run)
    modules = [
        data
        for path, data in package.sources.items()
        if path.endswith(".py") and path.split("/")[1] not in (*TESTS, "setup.py")
    ]
    imported = {name.split(".")[0] for data in modules for name in imports(data)}
    if any(names_used(data) & IMPORTING for data in modules):
        ends = [end for end in run.graph.endpoints if not end.from_course and end.name not in OF_EVERY_NODE]
        imported |= {"rclpy", *(end.type.split("/")[0] for end in ends if not is_node_service(end.name))}
    wanted = sorted(name for name in imported if ROS.fullmatch(name))
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
    _requires_short_output(package_of(run))
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


def build_warnings(package: Package) -> list[str]:
    """Return the warnings that Python printed in the build, each once."""
    found = map(WARNING.search, package.built.output.splitlines())
    return list(dict.fromkeys(line[1].strip() for line in found if line))


def builds_without_warnings(run: PackageRun) -> None:
    """The build prints no warning, and setup.py can hide none. Raises Missed, about the warning or ""."""
    package, expected = package_of(run), "no warning of colcon build"
    for warning in build_warnings(package):
        raise Missed(expected, f"“{warning}”", about=(warning,))
    _requires_short_output(package)
    setup = package.sources.get(f"{package.package_xml.name}/setup.py", b"")
    if "warnings" in imports(setup):
        raise Missed(expected, "a setup.py that imports warnings, to hide them", about=("",))
    for name in hiding(setup):
        raise Missed("a setup.py that calls setup(...), and nothing else", f"“{name}” in it", about=("",))


def hiding(setup: bytes) -> list[str]:
    """Return what a setup.py uses that could hide a warning: other modules, and os beyond its paths."""
    tree = list(ast.walk(parsed(setup)))
    modules = {name.split(".")[0] for name in imports(setup)} - IN_SETUP
    of_os = {
        part.attr
        for part in tree
        if isinstance(part, ast.Attribute) and getattr(part.value, "id", "") == "os"
    }
    return sorted(modules | {f"os.{name}" for name in of_os - OF_OS} | (names_used(setup) & HIDES))


def _requires_short_output(package: Package) -> None:
    """Raise Missed, about "", if the build printed so much that something is left out of its output."""
    if CUT in package.built.output:
        saw = f"more than {OUTPUT_BYTES // 1000} kB"
        raise Missed("the output of a build, which is short", saw, "Print nothing in setup.py.", about=("",))


def installs_only_its_name(run: PackageRun) -> None:
    """No Python package or module is installed but the one with the package's name. Raises Missed."""
    package = package_of(run)
    name = package.package_xml.name
    tops = {found[1].split("/")[0] for found in map(MODULES.fullmatch, package.built.files) if found}
    others = sorted(
        top.removesuffix(".py") for top in tops - {name} if not top.endswith((".egg-info", ".dist-info"))
    )
    if others:
        raise Missed(
            f"only {name} at the top of what is installed",
            f"also {', '.join(others)}",
            f"Other packages may install a module of the same name, and Python imports the first one that it "
            f"finds. Move your modules into the folder {name}/ that has __init__.py.",
        )


def imports_by_its_name(run: PackageRun) -> None:
    """Require that installed modules import each other by the package's name, and change no path."""
    package = package_of(run)
    built, name = package.built, package.package_xml.name
    modules = [path for path in built.files if MODULES.fullmatch(path) and path.endswith(".py")]
    installed = [*modules, *(path for path in built.programs if path.startswith(f"lib/{name}/"))]
    own = {path.rpartition("/")[2].removesuffix(".py") for path in installed} - {name}
    for path in sorted(installed):
        data = built.files[path]
        bare = [found for found in imports(data) if found.split(".")[0] in own]
        # The program that setuptools makes of an entry point uses importlib.
        changing = names_used(data) & (CHANGING if path in modules else CHANGING - {"importlib"})
        changes = "sys.path" if b"sys.path" in data else min(changing, default="")
        saw = changes or (f"an import of {bare[0]}" if bare else "")
        if saw:
            raise Missed(
                f"imports from {name} or {name}.MODULE",
                f"{saw} in {path.rpartition('/')[2]}",
                "A module of the package is found by the package's name, from every folder.",
            )


def names_used(data: bytes) -> set[str]:
    """Return the names and attributes in a module's code, and the modules that it imports."""
    parts = list(ast.walk(parsed(data)))
    names = {part.id for part in parts if isinstance(part, ast.Name)}
    names |= {part.attr for part in parts if isinstance(part, ast.Attribute)}
    return names | {name.split(".")[0] for name in imports(data)}


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
