"""What package.xml says, and the words where it says nothing that can be used."""

import pytest

from grader.workspace.package_xml import CMAKE, parse_package_xml
from grader.workspace.sources import InvalidFiles
from tests.exercises.launching.crates import students as crates
from tests.exercises.packages.greeter.students import RIGHT

XML = RIGHT["greeter/package.xml"]
PLACE = "ws/src/greeter/package.xml"


def described(xml, **other):
    return parse_package_xml({"greeter/package.xml": xml, "greeter/setup.py": b"", **other}, "greeter")


def test_a_package_says_its_name_and_its_needs():
    sources_ = described(XML.replace("<depend>rclpy</depend>", "<exec_depend>\nrclpy </exec_depend>").encode())
    assert (sources_.name, sources_.needs) == ("greeter", {"rclpy", "std_msgs"})
    assert described("\ufeff".encode() + XML.encode()).name == "greeter"


def test_a_package_of_interfaces_says_how_it_is_built_and_in_which_group_it_is():
    sources = {path: text.encode() for path, text in crates.RIGHT.items()}
    sources_ = parse_package_xml(sources, "crate_interfaces", CMAKE)
    assert sources_.needs == {"geometry_msgs", "rosidl_default_runtime"}
    assert sources_.tags["member_of_group"] == {"rosidl_interface_packages"}


@pytest.mark.parametrize(
    ("xml", "words"),
    [
        (b"", f"{PLACE} can't be read: line 1, column 1. Each <tag> needs its </tag>."),
        (XML.encode("utf-16"), f"{PLACE} can't be read. Save it as UTF-8."),
        (
            b"<!DOCTYPE a [<!ENTITY b 'c'>]><package/>",
            f"{PLACE} has a <!DOCTYPE> or an <!ENTITY>. It needs neither: leave them out.",
        ),
        (b"<package/>", f"{PLACE} gives its name as ''. It has to be greeter."),
        (
            b"<package><name>greeter</name></package>",
            f"{PLACE} has no build type. In <export> it needs <build_type>ament_python</build_type>.",
        ),
    ],
)
def test_what_can_not_be_used_is_refused(xml, words):
    with pytest.raises(InvalidFiles) as refused:
        described(xml)
    assert str(refused.value) == words


def test_nested_without_end_is_read_or_refused():
    with pytest.raises(InvalidFiles, match="can't be read"):
        described(b"<a>" * 80_000)
