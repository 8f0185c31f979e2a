"""Explains an error about a module, a package or a command that is not there."""

from __future__ import annotations

import re
import sys

from sim.absent_packages import explain, explain_package
from sim.ros.packages import packages
from sim.ros.workspaces import why_unavailable
from sim.suggestions import closest_match

# Exception -> the name in its text.
NAMES = {
    "ModuleNotFoundError": r"^No module named '(\w+)",
    "PackageNotFoundError": r"^\"package '(\w+)' not found",
    "PackageNotFound": r"^Package '(\w+)' not found",
    "SubstitutionFailure": r"^file not found: .*: '(\w+)'(?: \(.*\))?$",  # with its place in a launch file
}

LIKE_A_TYPO = 0.8  # least similarity of a module's name and one that is here


def explain_absent_name(error_type: str, text: str) -> str:
    """Return what the module or package in an error is, and how to get it; "" if neither is known."""
    found = re.search(NAMES[error_type], text) if error_type in NAMES else None
    if not found:
        return ""
    reason = why_unavailable(found[1])
    if reason:
        return f"Package `{found[1]}`: {reason}"
    is_package = error_type.startswith("PackageNotFound")
    explanation = explain_package(found[1]) if is_package else explain(found[1])
    if not explanation and error_type == "ModuleNotFoundError":
        return _unknown_module(text)
    if explanation or error_type != "PackageNotFoundError":
        return explanation
    return (
        f"No package `{found[1]}` is installed, and no workspace that has it was sourced: check its spelling."
    )


def _unknown_module(text: str) -> str:
    """Return where a module that is in no table can come from; "" if its name looks misspelt."""
    found = re.search(r"^No module named '(\w+)'$", text)
    if not found or closest_match(found[1], {*packages(), *sys.stdlib_module_names}, LIKE_A_TYPO):
        return ""
    return (
        f"Python can't find a module `{found[1]}`. Is it a file of yours? It has to be in the folder of the "
        "program, or in a package that is built and sourced. Is it a ROS package? The course does not "
        "include it: its source has to be in a workspace's src. Is it on PyPI? `%pip install` in a cell "
        "installs it."
    )
