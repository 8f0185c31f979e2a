"""launch and launch_ros have upstream's names and defaults; those of a ROS installation have precedence."""

import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
from launch.unsupported import LEFT_OUT

TABLE = Path(__file__).with_name("launch_api.txt").read_text(encoding="utf-8").splitlines()
NAMES = [line for line in TABLE if not line.startswith("#")]
REFUSED = [(module, name) for module, names in LEFT_OUT.items() for name in names.split()]


def arguments(thing) -> list[inspect.Parameter]:
    """All arguments of a class, those of its bases too where it hands on what it doesn't know."""
    if inspect.isfunction(thing):
        return list(inspect.signature(thing).parameters.values())
    found: dict[str, inspect.Parameter] = {}
    for base in thing.__mro__:
        if "__init__" not in vars(base) or base is object:
            continue
        own = list(inspect.signature(base.__init__).parameters.values())[1:]
        for each in own:
            if each.kind is not each.VAR_KEYWORD:
                found.setdefault(each.name, each)
        if not any(each.kind is each.VAR_KEYWORD for each in own):
            break
    return sorted(found.values(), key=lambda each: each.kind)


def shown(thing) -> str:
    words = []
    for each in arguments(thing):
        if each.kind is each.KEYWORD_ONLY and "*" not in words:
            words.append("*")
        default = each.default
        if default is each.empty:
            words.append(each.name)
        elif type(default).__module__.startswith("launch"):
            words.append(f"{each.name}=<{type(default).__name__}>")
        else:
            words.append(f"{each.name}={list(default) if isinstance(default, tuple) else default!r}")
    return f"({', '.join(words)})"


@pytest.mark.parametrize("line", NAMES)
def test_a_name_of_upstreams_is_there_with_its_arguments(line):
    name, given = re.fullmatch(r"([\w.]+)(\(.*\))", line).groups()
    assert shown(pkgutil.resolve_name(name)) == given


@pytest.mark.parametrize(("module", "name"), REFUSED)
def test_a_name_of_upstreams_that_is_left_out_is_refused_in_a_sentence(module, name):
    found = importlib.import_module(module)
    with pytest.raises(ImportError) as refused:
        getattr(found, name)
    there = ", ".join(sorted(found.__all__))
    assert (
        str(refused.value) == f"{module}.{name} is not supported by this course's launch, which has {there}."
    )


def test_an_unknown_name_raises_pythons_own_error():
    import launch_ros.actions

    with pytest.raises(AttributeError, match=r"^module 'launch_ros\.actions' has no attribute 'Nod'$"):
        _ = launch_ros.actions.Nod


def test_a_ros_installation_has_precedence(tmp_path):
    """Its packages are on PYTHONPATH, which comes before the course's ros.pth."""
    for package in ("launch", "launch_ros"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text("")
    program = "import launch, launch_ros; print(launch.__file__, launch_ros.__file__)"
    environment = {"PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, stdout=subprocess.PIPE, text=True, check=True
    )
    assert done.stdout.split() == [str(tmp_path / name / "__init__.py") for name in ("launch", "launch_ros")]
