"""Explains to a beginner why a build failed, from colcon's output."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.workspace.building import NOT_TAKEN, Built

LINES = 6  # of colcon's output, for an unknown cause
MAX_LINE = 300  # characters of a line
NO_SOURCE = "Look at the lines above, or run colcon build in ws, and read its first error."

RAISED = re.compile(r"^\w*(?:Error|Exception|Interrupt)\b.*$", re.M)
NO_COMMA = re.compile(r"'(?:tuple|list)' object is not callable")
JOINED = re.compile(r"""=\s*[\w.:]+(["'])\s*["']([\w-]+)\s*=""")  # two texts with no comma become one
NO_COMMA_BETWEEN = (
    "A comma is missing before the entry point {!r}: without it Python joins two strings into one."
)
IN_SETUP = re.compile(r'File "<string>", line (\d+)')

RULES: tuple[tuple[str, Callable[[re.Match[str]], str]], ...] = (
    (
        r"can't copy '([^']{1,200})': doesn't exist",
        lambda found: f"setup.py installs {found[1]}, but there is no such file. Create it, or fix the name.",
    ),
    (
        r"package directory '([^']{1,200})' does not exist",
        lambda found: f"setup.py names the package {found[1]!r}, but no folder next to it has that name.",
    ),
    (
        r"'distutils.core.setup\(\)' was never called",
        lambda found: (
            "setup.py ended without a setup(...) that could be used. Is it called? Each entry point has the "
            "form 'NAME = PACKAGE.MODULE:FUNCTION', with = and : in it."
        ),
    ),
    (
        r"MissingSectionHeaderError|configparser\.(?:\w+)",
        lambda found: "setup.cfg can't be read. It needs [develop] and [install], with a line below each.",
    ),
    (
        r"^error: (.{1,200})$",
        lambda found: f"setup.py says: {found[1]}",
    ),
)


def explain_build_error(built: Built, setup: str = "") -> tuple[str, str]:
    """The observation instead of a finished build, and a hint.

    setup: the text of setup.py. There is no hint if colcon finished: then the problem is sufficient.
    """
    if built.problem.startswith(NOT_TAKEN):
        return built.problem, ""
    joined = JOINED.search(setup)
    if joined:
        return built.problem, NO_COMMA_BETWEEN.format(joined[2])
    for pattern, explain in RULES:
        found = re.search(pattern, built.output, re.M)
        if found:
            return built.problem, explain(found)
    raised = RAISED.search(built.output)
    if raised:
        places = IN_SETUP.findall(built.output[: raised.start()])
        where = f"setup.py, line {places[-1]}" if places else "The first error is"
        comma = ". A comma is missing after the pair above it." if NO_COMMA.search(raised[0]) else ""
        return built.problem, f"{where}: {raised[0][:MAX_LINE]}{comma}"
    lines = [line for line in built.output.splitlines() if line.strip()][-LINES:]
    output = " / ".join(line.strip()[:MAX_LINE] for line in lines)
    return (f"{built.problem} Its last output: {output}" if output else built.problem), NO_SOURCE
