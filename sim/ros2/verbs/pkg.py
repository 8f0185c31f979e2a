"""ros2 pkg: the packages that are known here, and new ones."""

from __future__ import annotations

import shlex
from argparse import Namespace
from pathlib import Path
from xml.etree import ElementTree

from sim.ros.packages import PackageNotFound, command_of, executables, packages, prefix_of
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import Voice, Wrong

pkg = Group("pkg", "Various package related sub-commands")
PACKAGE = argument("package_name", help="The package name", offers=lambda *_: packages())
NOT_FOUND = "Package not found"


@pkg.verb("list", alone=True)
def list_(voice: Voice, asked: Namespace) -> None:
    """Output a list of available packages."""
    for name in packages():
        voice.say(name)


@pkg.verb(
    "executables",
    argument("package_name", nargs="?", help="The package name", offers=lambda *_: packages()),
    flag("--full-path", help="Show full path of each executable"),
    alone=True,
)
def executables_(voice: Voice, asked: Namespace) -> None:
    """Output a list of package specific executables."""
    for package in packages() if asked.package_name is None else [asked.package_name]:
        try:
            names = executables(package)
        except PackageNotFound as error:
            raise Wrong(str(error)) from None
        for name in names:
            voice.say(shlex.join(command_of(package, name)) if asked.full_path else f"{package} {name}")


@pkg.verb("prefix", PACKAGE, flag("--share", help="Show share directory for the package"), alone=True)
def prefix(voice: Voice, asked: Namespace) -> None:
    """Output the prefix path of a package."""
    voice.say(str(_share(asked.package_name) if asked.share else _prefix(asked.package_name)))


@pkg.verb("xml", PACKAGE, argument("-t", "--tag", help="The XML tag to output (e.g. 'version')"), alone=True)
def xml(voice: Voice, asked: Namespace) -> None:
    """Output the XML of the package manifest or a specific tag."""
    file = _share(asked.package_name) / "package.xml"
    if not file.is_file():
        raise Wrong("Package XML manifest not found")
    root = ElementTree.parse(file).getroot()
    if asked.tag is None:
        voice.say(ElementTree.tostring(root, encoding="unicode"))
        return
    found = root.findall(asked.tag)
    if not found:
        raise Wrong("XML tag not found")
    for element in found:
        voice.say(element.text or "")


def _prefix(package: str) -> Path:
    try:
        return prefix_of(package)
    except PackageNotFound:
        raise Wrong(NOT_FOUND) from None


def _share(package: str) -> Path:
    return _prefix(package) / "share" / package
