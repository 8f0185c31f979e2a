"""Checks that imports follow the layers of the map and have no cycles."""

import ast
import fnmatch
import functools
import json
import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("sim", "grader")

ROS_LAYERS = ("sim/ros/", "sim/ros2/", "grader/companions/", "grader/exercises/")
ROS_LAYERS += ("grader/checks/interface_definitions.py",)  # rosidl's parser, which is no part of a node
ROS = re.compile(r"rclpy|rosidl\w*|rpyutils|ament_index_python|\w+_msgs|\w+_interfaces|std_srvs")
JUPYTER = re.compile(r"IPython|ipykernel|ipywidgets|anywidget|jupyter\w*|nbclient|nbconvert|traitlets")
PICTURES = re.compile(r"matplotlib")
NBGRADER = re.compile(r"nbgrader")
GRADER = re.compile(r"grader")
JUPYTER_LAYERS = ("sim/view/", "grader/score.py", "grader/course_files/notebook_client.py", "grader/marking/")

# Names of packages, and the only modules that may import them. A path that ends with / is a whole folder.
LAYERS = [
    pytest.param(ROS, ROS_LAYERS, id="ROS"),
    pytest.param(JUPYTER, JUPYTER_LAYERS, id="Jupyter"),
    pytest.param(PICTURES, ("sim/view/", "grader/pictures.py", "grader/marking/preload.py"), id="matplotlib"),
    pytest.param(NBGRADER, ("grader/marking/",), id="nbgrader"),
    pytest.param(GRADER, ("grader/",), id="grader"),
]
PUBLIC_MODULES = {"sim", "sim.view", "grader", "grader.exercises"}

# The packages and modules of sim/ros, from the bottom: each imports only from itself and those before it.
SIM_ROS = (
    *("bundled_programs", "workspaces", "packages", "absent_names", "left_out", "parameter_sources"),
    *("attached", "rclpy_cpp", "messages", "built_interfaces", "sourcing"),
    *("fibers", "recorder", "transport", "engine", "hooks", "robots"),
    *("ground_truth", "latest", "launching", "bags", "session", "play"),
    *("remote", "run", "exploring", "realtime"),
)

# The folders of ros_packages/ that are on Python's path, and the packages that no module in them imports.
ROS_PACKAGES = ("ros_packages/python", "ros_packages/interfaces")
COURSE = re.compile(rf"sim|grader|{JUPYTER.pattern}|{PICTURES.pattern}|{NBGRADER.pattern}")

# The modules of launch, launch_ros and launch_pytest, from the bottom: each imports from its own layer and
# those before it.
LAUNCH_LAYERS = (
    ("launch_process_starters",),
    ("launch.event", "launch.processes", "launch.launch_context", "launch.launch_description_entity"),
    ("launch.located",),
    ("launch.events", "launch.events.*", "launch.event_handler", "launch.condition", "launch.action"),
    ("launch.logging", "launch.unsupported", "launch.substitution", "launch.utilities"),
    ("launch.substitutions", "launch.substitutions.*", "launch.conditions"),
    ("launch.actions.*",),
    ("launch.launch_description", "launch.launch_description_sources"),
    ("launch.actions.include_launch_description", "launch.actions"),
    ("launch.event_handlers", "launch.launch_introspector", "launch.launch_service", "launch"),
    ("launch.yaml_frontend", "launch.yaml_frontend.*"),
    ("launch_ros", "launch_ros.*"),
    ("launch.yaml_frontend.launch_file",),  # it imports the actions of launch_ros
    ("launch_pytest", "launch_pytest.*"),
)


@functools.cache
def import_statements(source: str) -> list[tuple[ast.Import | ast.ImportFrom, bool]]:
    """The imports of a source at any level of nesting, and whether each is for annotations only."""
    found, typing = [], set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            typing |= {id(inner) for inner in ast.walk(node)}
        elif isinstance(node, ast.Import | ast.ImportFrom):
            found.append(node)
    return [(node, id(node) in typing) for node in found]


@functools.cache
def imports(source: str) -> tuple[str, ...]:
    """The full name of every module that the source imports, at any level of nesting."""
    found: list[str] = []
    for node, _ in import_statements(source):
        if isinstance(node, ast.Import):
            found += [name.name for name in node.names]
        elif not node.level:
            found.append(node.module or "")
    return tuple(found)


def modules() -> Iterator[tuple[str, str]]:
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


def module_files(folder: str) -> dict[str, str]:
    """The sources of the modules in a folder on Python's path, by name."""
    root = ROOT / folder
    return {
        module_name(path.relative_to(root).as_posix()): path.read_text(encoding="utf-8")
        for path in sorted(root.rglob("*.py"))
    }


def forbidden_imports(
    allowed: tuple[str, ...], names: re.Pattern, files: Iterator[tuple[str, str]]
) -> list[str]:
    """Return "file imports module" for each such import in a file that is not allowed to have it."""
    return [
        f"{file} imports {module}"
        for file, source in files
        if not file.startswith(allowed)
        for module in imports(source)
        if names.fullmatch(module.split(".")[0])
    ]


def notebook_code(path: Path) -> str:
    """Return the Python code of a notebook, without IPython's own commands."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    sources = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    python = "\n".join(source for source in sources if not source.startswith("%%"))
    return re.sub(r"^(\s*)[%!].*$", r"\1pass", python, flags=re.M)


def module_name(file: str) -> str:
    """The import name of the module in a file such as "sim/world/__init__.py"."""
    return file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def import_graph(files: dict[str, str], *, annotations: bool) -> dict[str, set[str]]:
    """The modules that each of these modules (name to source) imports from among them.

    annotations: include imports under `if TYPE_CHECKING:`.
    """
    found: dict[str, set[str]] = {}
    for module, source in files.items():
        names = [
            name
            for node, for_annotations in import_statements(source)
            if annotations or not for_annotations
            for name in _imported(node, files)
        ]
        found[module] = {name for name in names if name in files and name != module}
    return found


def _imported(node: ast.Import | ast.ImportFrom, files: dict[str, str]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (name.name for name in node.names)
    elif node.module:
        for name in node.names:  # a module of a package, or a name in a module
            inner = f"{node.module}.{name.name}"
            yield inner if inner in files else node.module


def find_cycle(graph: dict[str, set[str]]) -> list[str]:
    """The names of the modules on a cycle, or [] if there is none."""
    try:
        tuple(TopologicalSorter(graph).static_order())
    except CycleError as error:
        return error.args[1]
    return []


def part_of_sim_ros(module: str) -> str | None:
    """The package or module of sim/ros that a module belongs to; None for any other module."""
    parts = module.split(".")
    return parts[2] if parts[:2] == ["sim", "ros"] and len(parts) > 2 else None


def launch_layer(module: str) -> int | None:
    """The index of the layer of a module of launch or launch_ros; None for any other module.

    A layer with the module's own name has precedence over one with a matching pattern.
    """
    for matches in (str.__eq__, fnmatch.fnmatchcase):
        for number, layer in enumerate(LAUNCH_LAYERS):
            if any(matches(module, pattern) for pattern in layer):
                return number
    return None


@pytest.mark.parametrize(("names", "allowed"), LAYERS)
def test_a_library_is_imported_only_by_the_layers_on_the_map(names, allowed):
    assert forbidden_imports(allowed, names, modules()) == []


def test_the_untrusted_process_imports_nothing_of_the_grading_process():
    shared, own = "grader.marking.outputs", "grader.marking.student_process"
    places = ("grader/marking/student_process/", "grader/marking/outputs.py")
    used = {
        f"{file} imports {module}"
        for file, source in modules()
        if file.startswith(places)
        for module in imports(source)
        if module.startswith("grader.marking.") and not module.startswith((shared, own))
    }
    assert used == set()


@pytest.mark.parametrize("folder", ["course", "solutions"])
def test_notebooks_import_public_modules_only(folder):
    used = {
        f"{path.relative_to(ROOT)} imports {module}"
        for path in sorted((ROOT / folder).rglob("*.ipynb"))
        for module in imports(notebook_code(path))
        if module.split(".")[0] in PACKAGES and module not in PUBLIC_MODULES
    }
    assert used == set()


def test_a_forbidden_import_is_found_at_any_level_of_nesting():
    source = "def f():\n    if True:\n        from rclpy.node import Node\nimport geometry_msgs.msg, math\n"
    files = [("sim/world/robot.py", source), ("sim/ros/engine/engine.py", source)]
    assert forbidden_imports(("sim/ros/",), ROS, iter(files)) == [
        "sim/world/robot.py imports geometry_msgs.msg",
        "sim/world/robot.py imports rclpy.node",
    ]


def test_only_the_two_packages_are_installed_and_both_have_modules():
    assert {file.split("/")[0] for file, _ in modules()} == set(PACKAGES)


def test_no_imports_form_a_cycle():
    """Not even imports for annotations."""
    files = {module_name(file): source for file, source in modules()}
    assert find_cycle(import_graph(files, annotations=True)) == []


def test_sim_ros_imports_in_one_direction():
    files = {module_name(file): source for file, source in modules()}
    back = [
        f"{module} imports {other}"
        for module, others in import_graph(files, annotations=True).items()
        for other in others
        if part_of_sim_ros(module) is not None and part_of_sim_ros(other) is not None
        if SIM_ROS.index(part_of_sim_ros(other)) > SIM_ROS.index(part_of_sim_ros(module))
    ]
    assert back == []


def test_sim_ros_imports_no_ros2_commands():
    files = {module_name(file): source for file, source in modules()}
    graph = import_graph(files, annotations=True)
    upward = {
        f"{module} imports {other}"
        for module in graph
        if part_of_sim_ros(module) is not None
        for other in graph[module]
        if other.split(".")[:2] == ["sim", "ros2"]
    }
    assert upward == set()


@pytest.mark.parametrize("folder", ROS_PACKAGES)
def test_no_imports_of_ros_packages_form_a_cycle(folder):
    """Not even imports for annotations."""
    assert find_cycle(import_graph(module_files(folder), annotations=True)) == []


@pytest.mark.parametrize("folder", ROS_PACKAGES)
def test_ros_packages_import_nothing_of_the_course(folder):
    files = {f"{folder}: {name}": source for name, source in module_files(folder).items()}
    assert forbidden_imports((), COURSE, iter(files.items())) == []


def test_launch_imports_in_one_direction():
    files = module_files("ros_packages/python")
    layers = {name: launch_layer(name) for name in files if name.startswith("launch")}
    assert [name for name, layer in layers.items() if layer is None] == []
    back = [
        f"{module} imports {other}"
        for module, others in import_graph(files, annotations=True).items()
        for other in others
        if module in layers and other in layers and layers[other] > layers[module]
    ]
    assert back == []


def test_a_run_sets_one_attribute_on_objects_that_are_not_its_own_and_one_module_knows_it():
    assert [file for file, source in modules() if re.search(r"\._sim\b|\._sim_|[\"']_sim[\"'_]", source)] == [
        "sim/ros/attached.py"
    ]


def test_a_cycle_is_found_at_any_level_of_nesting():
    files = {
        "sim.a": "from sim import b",
        "sim.b": "def f():\n    import sim.c",
        "sim.c": "from sim.a import x\nif TYPE_CHECKING:\n    from sim.d import y",
        "sim.d": "import sim.c",
    }
    assert set(find_cycle(import_graph(files, annotations=False))) == {"sim.a", "sim.b", "sim.c"}
    apart = {name: source for name, source in files.items() if name in ("sim.c", "sim.d")}
    assert find_cycle(import_graph(apart, annotations=False)) == []
    assert set(find_cycle(import_graph(apart, annotations=True))) == {"sim.c", "sim.d"}
