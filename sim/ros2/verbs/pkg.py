"""ros2 pkg: information about packages."""

from __future__ import annotations

import shlex
from argparse import Namespace
from pathlib import Path
from xml.etree import ElementTree

from sim.ros.packages import PackageNotFound, command_of, executables, packages, prefix_of
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import CliError, Output

pkg = Group("pkg", "Various package related sub-commands")
PACKAGE = argument("package_name", help="The package name", completer=lambda *_: packages())
NOT_FOUND = "Package not found"


@pkg.verb("list", without_system=True)
def list_(output: Output, options: Namespace) -> None:
    """Output a list of available packages."""
    for name in packages():
        output.print_line(name)


@pkg.verb(
    "executables",
    argument("package_name", nargs="?", help="The package name", completer=lambda *_: packages()),
    flag("--full-path", help="Show full path of each executable"),
    without_system=True,
)
def executables_(output: Output, options: Namespace) -> None:
    """Output a list of package specific executables."""
    for package in packages() if options.package_name is None else [options.package_name]:
        try:
            names = executables(package)
        except PackageNotFound as error:
            raise CliError(str(error)) from None
        for name in names:
            output.print_line(
                shlex.join(command_of(package, name)) if options.full_path else f"{package} {name}"
            )


@pkg.verb(
    "prefix", PACKAGE, flag("--share", help="Show share directory for the package"), without_system=True
)
def prefix(output: Output, options: Namespace) -> None:
    """Output the prefix path of a package."""
    output.print_line(str(_share(options.package_name) if options.share else _prefix(options.package_name)))


@pkg.verb(
    "xml",
    PACKAGE,
    argument("-t", "--tag", help="The XML tag to output (e.g. 'version')"),
    without_system=True,
)
def xml(output: Output, options: Namespace) -> None:
    """Output the XML of the package manifest or a specific tag."""
    file = _share(options.package_name) / "package.xml"
    if not file.is_file():
        raise CliError("Package XML manifest not found")
    root = ElementTree.parse(file).getroot()
    if options.tag is None:
        output.print_line(ElementTree.tostring(root, encoding="unicode"))
        return
    found = root.findall(options.tag)
    if not found:
        raise CliError("XML tag not found")
    for element in found:
        output.print_line(element.text or "")


def _prefix(package: str) -> Path:
    try:
        return prefix_of(package)
    except PackageNotFound:
        raise CliError(NOT_FOUND) from None


def _share(package: str) -> Path:
    return _prefix(package) / "share" / package
