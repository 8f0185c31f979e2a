"""The course's Python packages have upstream's names and defaults; an installation of ROS has precedence."""

import inspect
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
from rclpy.duration import Duration

TABLE = Path(__file__).with_name("python_api.txt").read_text(encoding="utf-8").splitlines()
NAMES = [line for line in TABLE if not line.startswith("#")]
FOLDER = Path(__file__).parents[2] / "ros_packages" / "python"
PACKAGES = sorted(file.parent.name for file in FOLDER.glob("*/__init__.py"))


def signature(thing) -> str:
    def shown(argument: inspect.Parameter) -> inspect.Parameter:
        zero = isinstance(argument.default, Duration) and argument.default == Duration()
        default = Zero() if zero else argument.default
        return argument.replace(annotation=inspect.Parameter.empty, default=default)

    found = inspect.signature(thing)
    return str(
        found.replace(
            parameters=map(shown, found.parameters.values()), return_annotation=inspect.Signature.empty
        )
    )


class Zero:
    def __repr__(self) -> str:
        return "0 s"


@pytest.mark.parametrize("line", NAMES)
def test_a_name_of_upstreams_is_there_with_its_arguments(line):
    name, arguments = re.fullmatch(r"([\w.]+)(\(.*\))?", line).groups()
    found = pkgutil.resolve_name(name)
    if arguments is not None:
        assert signature(found) == arguments


def test_all_exceptions_of_a_lookup_are_transform_exceptions():
    import tf2_ros

    kinds = ("Connectivity", "Lookup", "Extrapolation", "InvalidArgument", "Timeout")
    assert all(issubclass(getattr(tf2_ros, f"{kind}Exception"), tf2_ros.TransformException) for kind in kinds)


def test_an_installation_of_ros_wins(tmp_path):
    """Its packages are on PYTHONPATH, which comes before the course's ros.pth."""
    for package in PACKAGES:
        (tmp_path / "ros" / package).mkdir(parents=True)
        (tmp_path / "ros" / package / "__init__.py").write_text("")
    program = "import sys, importlib\nfor name in sys.argv[1:]: print(importlib.import_module(name).__file__)"
    done = subprocess.run(
        [sys.executable, "-c", program, *PACKAGES],
        env={"PYTHONPATH": str(tmp_path / "ros")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == [str(tmp_path / "ros" / name / "__init__.py") for name in PACKAGES]


def test_tf2_ros_has_the_names_that_upstreams_modules_import():
    """The official tutorial on URDF imports TransformStamped from it."""
    import tf2_py
    import tf2_ros
    from geometry_msgs.msg import TransformStamped

    names: dict = {}
    exec("from tf2_ros import *", names)
    assert names["TransformStamped"] is tf2_ros.TransformStamped is TransformStamped
    assert names["tf2"] is tf2_py
    found = [name for module in tf2_ros.IMPORTED_UPSTREAM.values() for name in module]
    assert all(getattr(tf2_ros, name).__name__ == name for name in found)
    with pytest.raises(AttributeError, match=r"^module 'tf2_ros' has no attribute 'TransformStampd'$"):
        tf2_ros.TransformStampd  # noqa: B018
