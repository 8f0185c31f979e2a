"""Explains an error about a module, a package or a command that is not there."""

from __future__ import annotations

import re

from sim.absent_packages import explain
from sim.ros.workspaces import why_unavailable

# Exception -> the name in its text.
NAMES = {
    "ModuleNotFoundError": r"^No module named '(\w+)",
    "PackageNotFoundError": r"^\"package '(\w+)' not found",
    "PackageNotFound": r"^Package '(\w+)' not found",
    "SubstitutionFailure": r"^file not found: .*: '(\w+)'$",
}


def explain_absent_name(error_type: str, text: str) -> str:
    """What the module or package in an error is, and how to get it; "" if neither is known."""
    found = re.search(NAMES[error_type], text) if error_type in NAMES else None
    if not found:
        return ""
    reason = why_unavailable(found[1])
    if reason:
        return f"Package `{found[1]}`: {reason}"
    explanation = explain(found[1])
    if explanation or error_type != "PackageNotFoundError":
        return explanation
    return (
        f"No package `{found[1]}` is installed, and no workspace that has it was sourced: check its spelling."
    )
