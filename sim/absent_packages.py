"""Packages and modules that the course lacks: what each is, and what to use in its place."""

from __future__ import annotations

import functools
import tomllib
from pathlib import Path
from typing import Any

TABLE = Path(__file__).with_suffix(".toml")


def explain(name: str) -> str:
    """A sentence or two about a package or module that the course lacks, or "" if it is not a known one."""
    rows = table()
    if name in rows["ros1"]:
        return f"`{name}` is a package of ROS 1. ROS 2 has {rows['ros1'][name]}."
    if name in rows["pypi"]:
        return (
            f"`{name}` is a Python package that is not installed here: `%pip install {rows['pypi'][name]}` "
            "in a cell installs it. It is available for marking only if the instructor installs it, too."
        )
    if name in rows["ros"]:
        return _explain_ros(name, rows["ros"][name])
    return ""


def explain_package(name: str) -> str:
    """Work like `explain`, about a name that was looked up as a ROS package, which pip does not install."""
    project = table()["pypi"].get(name)
    if project is None:
        return explain(name)
    return (
        f"The course has no ROS package `{name}`, and `%pip install {project}` installs none. If that "
        f"installs a program `{name}`, start it by its name: `$(command '{name} FILE')` in XML or YAML, "
        f'`Command(["{name} ", FILE])` in Python.'
    )


def _explain_ros(name: str, row: dict[str, Any]) -> str:
    sentences = [f"`{name}` ({row['about']}) is a ROS package that the course does not include."]
    if "instead" in row:
        sentences.append(row["instead"])
    if row.get("cpp"):
        sentences.append("C++ nodes are not built here.")
    return " ".join(sentences)


@functools.cache
def table() -> dict[str, dict[str, Any]]:
    """The table: "ros", "pypi" and "ros1", each with a row for each name."""
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))
