"""Reads the imports and holds the layers of the map apart."""
import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("sim", "grader")

ROS = re.compile(r"rclpy|rosidl\w*|rpyutils|ament_index_python|\w+_msgs|\w+_interfaces|std_srvs")
JUPYTER = re.compile(r"IPython|ipykernel|ipywidgets|anywidget|jupyter\w*|nbclient|nbconvert|traitlets")
PICTURES = re.compile(r"matplotlib")
NBGRADER = re.compile(r"nbgrader")
GRADER = re.compile(r"grader")

# What may be imported by which modules and nobody else. A path that ends with / is a whole folder.
LAYERS = [
    pytest.param(ROS, ("sim/ros/", "grader/exercises/"), id="ROS"),
    pytest.param(JUPYTER, ("sim/view/", "grader/score.py", "grader/marking/"), id="Jupyter"),
    pytest.param(PICTURES, ("sim/view/", "grader/pictures.py", "grader/marking/warm.py"), id="matplotlib"),
    pytest.param(NBGRADER, ("grader/marking/",), id="nbgrader"),
    pytest.param(GRADER, ("grader/",), id="grader"),
]
DOORS = {"sim", "sim.view", "grader", "grader.exercises"}


def imports(source: str) -> Iterator[str]:
    """Yield the full name of every module that the source imports, wherever the statement stands."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module or ""


def modules() -> Iterator[tuple[str, str]]:
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


def strangers(allowed: tuple[str, ...], names: re.Pattern, files: Iterator[tuple[str, str]]) -> list[str]:
    """Return "file imports module" for each import of such a module by a file that is not allowed to."""
    return [
        f"{file} imports {module}"
        for file, source in files
        if not file.startswith(allowed)
        for module in imports(source)
        if names.fullmatch(module.split(".")[0])
    ]


def notebook_code(path: Path) -> str:
    """Return the Python of a notebook, without IPython's own commands."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    sources = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    python = "\n".join(source for source in sources if not source.startswith("%%"))
    return re.sub(r"^(\s*)[%!].*$", r"\1pass", python, flags=re.M)


@pytest.mark.parametrize(("names", "allowed"), LAYERS)
def test_a_layer_is_known_only_where_the_map_says(names, allowed):
    assert strangers(allowed, names, modules()) == []


@pytest.mark.parametrize("folder", ["course", "solutions"])
def test_notebooks_use_the_doors_only(folder):
    used = {
        f"{path.relative_to(ROOT)} imports {module}"
        for path in sorted((ROOT / folder).rglob("*.ipynb"))
        for module in imports(notebook_code(path))
        if module.split(".")[0] in PACKAGES and module not in DOORS
    }
    assert used == set()


def test_a_wrong_import_is_found_wherever_it_stands():
    source = "def f():\n    if True:\n        from rclpy.node import Node\nimport geometry_msgs.msg, math\n"
    files = [("sim/world/robot.py", source), ("sim/ros/engine.py", source)]
    assert strangers(("sim/ros/",), ROS, iter(files)) == [
        "sim/world/robot.py imports geometry_msgs.msg",
        "sim/world/robot.py imports rclpy.node",
    ]


def test_only_the_two_packages_are_installed_and_both_have_modules():
    assert {file.split("/")[0] for file, _ in modules()} == set(PACKAGES)
