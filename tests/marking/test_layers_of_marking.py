"""How the packages of grader/marking depend on each other."""
import subprocess
import sys

from tests.tooling.test_layers import ROOT, find_cycle, import_graph, imports, module_name, modules

MARKING, EXTRAS = "grader.marking.", "grader.marking.extras"
BLOCKED = f"""
import importlib, importlib.util, pkgutil, sys

class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.startswith("{EXTRAS}"):
            raise ModuleNotFoundError(name)

sys.meta_path.insert(0, Blocker())
import grader.marking
for module in pkgutil.walk_packages(grader.marking.__path__, "{MARKING}", onerror=lambda name: None):
    if not module.name.startswith("{EXTRAS}"):
        importlib.import_module(module.name)
from grader.__main__ import main
print(main(["--help"]), main(["league"]))
"""


def sources() -> dict[str, str]:
    """The sources of all modules of marking, by name."""
    return {module_name(file): text for file, text in modules() if file.startswith("grader/marking/")}


def test_no_imports_form_a_cycle_not_even_those_for_annotations():
    assert find_cycle(import_graph(sources(), annotations=True)) == []


def test_no_imports_of_packages_form_a_cycle():
    packages: dict[str, set[str]] = {}
    for module, others in import_graph(sources(), annotations=True).items():
        package = _package(module)
        packages.setdefault(package, set()).update(_package(other) for other in others)
        packages[package].discard(package)
    assert packages["judge"] >= {"submission", "task"}
    assert find_cycle(packages) == []


def test_the_core_imports_nothing_of_the_extras():
    core = {module: text for module, text in sources().items() if not module.startswith(EXTRAS)}
    assert {name for text in core.values() for name in imports(text) if name.startswith(EXTRAS)} == set()


def test_without_the_optional_packages_the_core_can_be_imported_and_other_commands_are_not_offered():
    command = [sys.executable, "-c", BLOCKED]
    done = subprocess.run(command, cwd=ROOT, text=True, capture_output=True)
    usage = "usage: python -m grader COMMAND ...\nCommands, each with --help: due, mark\n"
    assert (done.stdout, done.stderr, done.returncode) == (usage + "0 2\n", usage, 0)


def _package(module: str) -> str:
    return module.removeprefix(MARKING).split(".")[0]
