"""Parses package.xml, without executing anything of the package."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from xml.etree import ElementTree

from grader.workspace.sources import InvalidFiles, Sources

FILE = "package.xml"
NEEDED = ("depend", "exec_depend", "run_depend")  # the dependencies at run time
PYTHON, CMAKE = "ament_python", "ament_cmake"
BUILT_BY = {PYTHON: "setup.py", CMAKE: "CMakeLists.txt"}


@dataclass(frozen=True)
class PackageXml:
    """A package's name, and the texts of each tag below <package>: tag to texts."""

    name: str
    tags: Mapping[str, frozenset[str]]

    @property
    def needs(self) -> frozenset[str]:
        """The declared dependencies at run time."""
        return frozenset().union(*(self.tags.get(tag, ()) for tag in NEEDED))


def parse_package_xml(sources: Sources, package: str, build_type: str = PYTHON) -> PackageXml:
    """The package.xml of the package in the folder of this name.

    Raises InvalidFiles if colcon would not build it, or under another name.
    """
    place = f"ws/src/{package}"
    if not any(path.startswith(f"{package}/") for path in sources):
        raise InvalidFiles(f"There is no {place}. A package is in a folder of its own name in ws/src.")
    data = sources.get(f"{package}/{FILE}")
    if data is None:
        raise InvalidFiles(
            f"There is no {place}/{FILE}. Without it, colcon doesn't recognize the folder as a package."
        )
    root = _parsed(data, place)
    name = (root.findtext("name") or "").strip()
    if name != package:
        raise InvalidFiles(f"{place}/{FILE} gives its name as {name[:60]!r}. It has to be {package}.")
    kind = (root.findtext("export/build_type") or "").strip()
    if kind != build_type:
        saw = f"gives {kind[:60]!r} as its build type" if kind else "has no build type"
        raise InvalidFiles(
            f"{place}/{FILE} {saw}. In <export> it needs <build_type>{build_type}</build_type>."
        )
    if f"{package}/{BUILT_BY[build_type]}" not in sources:
        raise InvalidFiles(f"There is no {place}/{BUILT_BY[build_type]}. It defines what is installed.")
    tags: dict[str, set[str]] = defaultdict(set)
    for item in root:
        tags[item.tag].add((item.text or "").strip())
    return PackageXml(name, {tag: frozenset(texts) for tag, texts in tags.items()})


def _parsed(data: bytes, place: str) -> ElementTree.Element:
    try:
        text = data.decode("utf-8-sig")
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            problem = f"{place}/{FILE} has a <!DOCTYPE> or an <!ENTITY>."
            raise InvalidFiles(f"{problem} It needs neither: leave them out.")
        return ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        line, column = error.position
        problem = f"{place}/{FILE} can't be read: line {line}, column {column + 1}."
        raise InvalidFiles(f"{problem} Each <tag> needs its </tag>.") from None
    except ValueError:
        raise InvalidFiles(f"{place}/{FILE} can't be read. Save it as UTF-8.") from None
