"""Every definition is a type that the real rclpy imports, fills, sends and reads."""

import functools
import tomllib
from importlib import import_module
from pathlib import Path

import pytest
from ament_index_python import get_package_share_directory, get_resource
from build_tools.toolchain import ros_prefix
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.type_support import check_for_type_support
from rosidl_adapter.parser import (
    MessageSpecification,
    parse_action_string,
    parse_message_string,
    parse_service_string,
)

DEFINITIONS = Path(__file__).resolve().parents[3] / "ros_packages" / "interfaces" / "definitions"
PACKAGES = sorted(path.name for path in DEFINITIONS.iterdir())
INTERFACES = sorted(str(file.relative_to(DEFINITIONS)) for file in DEFINITIONS.glob("*/*/*.*"))
OWN = "warehouse_msgs/"  # the others are upstream's
PARTS = {"msg": [], "srv": ["Request", "Response"], "action": ["Goal", "Result", "Feedback"]}
PARSERS = {"msg": parse_message_string, "srv": parse_service_string, "action": parse_action_string}
UPSTREAM = tomllib.loads((DEFINITIONS.parent / "upstream_constants.toml").read_text(encoding="utf-8"))


def load(interface: str) -> type:
    """The type of a definition, or of a part of it such as nav2_msgs/action/Spin_Goal."""
    package, kind, name = Path(interface).with_suffix("").parts
    return functools.reduce(getattr, name.split("_"), import_module(f"{package}.{kind}"))


def specifications(interface: str) -> list[tuple[str, MessageSpecification]]:
    """The messages of a definition, each with what its name has after the interface's."""
    package, kind, name = Path(interface).with_suffix("").parts
    parsed = PARSERS[kind](package, name, (DEFINITIONS / interface).read_text(encoding="utf-8"))
    return [(f"_{part}", getattr(parsed, part.lower())) for part in PARTS[kind]] or [("", parsed)]


def constants_and_defaults(specification: MessageSpecification) -> dict[str, object]:
    constants = {constant.name: constant.value for constant in specification.constants}
    defaults = {field.name: field.default_value for field in specification.fields}
    return constants | {name: value for name, value in defaults.items() if value is not None}


@pytest.mark.parametrize("interface", INTERFACES)
def test_every_definition_has_type_support(interface):
    check_for_type_support(load(interface))


@pytest.mark.parametrize("interface", INTERFACES)
def test_every_message_comes_back_equal_from_the_wire_format(interface):
    whole = load(interface)
    for part in [getattr(whole, name) for name in PARTS[Path(interface).parts[1]]] or [whole]:
        assert deserialize_message(serialize_message(part()), part) == part()


@pytest.mark.parametrize("interface", INTERFACES)
def test_every_definition_begins_with_a_comment_that_says_what_it_is(interface):
    first = (DEFINITIONS / interface).read_text(encoding="utf-8").splitlines()[0]
    assert first.startswith("# ") and first.endswith(".")


@pytest.mark.parametrize("package", PACKAGES)
def test_tools_find_a_package_and_its_definitions_through_the_ament_index(package, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(ros_prefix()))
    listed, _ = get_resource("rosidl_interfaces", package)
    share = Path(get_package_share_directory(package))
    assert share.name == package
    for interface in INTERFACES:
        owner, kind, name = Path(interface).parts
        if owner == package:
            assert f"{kind}/{name}" in listed.splitlines()
            assert (share / kind / name).read_bytes() == (DEFINITIONS / interface).read_bytes()


@pytest.mark.parametrize("interface", [name for name in INTERFACES if not name.startswith(OWN)])
def test_constants_and_defaults_are_upstreams(interface):
    name = str(Path(interface).with_suffix(""))
    written = {f"{name}{part}": constants_and_defaults(spec) for part, spec in specifications(interface)}
    assert written == {part: UPSTREAM.get(part, {}) for part in written}


@pytest.mark.parametrize("name", UPSTREAM)
def test_the_built_type_has_upstreams_constants_and_defaults(name):
    built = load(name)()  # an instance has its type's constants, too
    assert {each: getattr(built, each) for each in UPSTREAM[name]} == UPSTREAM[name]


def test_a_whole_number_in_a_float_field_is_sent_as_that_number():
    from nav2_msgs.action import Spin

    goal = Spin.Goal()
    # Past the setter: where field checks are on, it refuses what is tested here.
    goal._target_yaw = 2
    assert deserialize_message(serialize_message(goal), Spin.Goal).target_yaw == 2.0
