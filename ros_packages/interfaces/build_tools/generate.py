"""Generates C, C++ and Python sources from .msg, .srv and .action files by the generators of the ROS wheels.

Upstream does this in CMake, in rosidl_generate_interfaces().
"""

import json
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from build_tools.rosidl import cache_parsing
from build_tools.toolchain import BuildError, ros_prefix

KINDS = ("msg", "srv", "action")
GENERATOR_C = "rosidl_generator_c"
FASTRTPS = "rosidl_typesupport_fastrtps_c"
INTROSPECTION = "rosidl_typesupport_introspection_c"
DISPATCHER = "rosidl_typesupport_c"
GENERATOR_PY = "rosidl_generator_py"
DESCRIPTION = "rosidl_generator_type_description"


@dataclass(frozen=True)
class Package:
    """An interface package and the directories of its generated files.

    Attributes:
        name: the ROS package name.
        source: the directory with msg/, srv/ and action/.
        output: the directory for share/, include/, introspection/ and python/. A package may use those that
            were built into the same directory before it.
    """

    name: str
    source: Path
    output: Path

    @property
    def interfaces(self) -> list[str]:
        """The definition files, for example "msg/Bool.msg", in a fixed order."""
        files = (file for kind in KINDS for file in self.source.glob(f"{kind}/*.{kind}"))
        return sorted(str(file.relative_to(self.source)) for file in files)

    @property
    def idls(self) -> list[str]:
        """The .idl file of each interface, for example "msg/Bool.idl"."""
        return [str(Path(interface).with_suffix(".idl")) for interface in self.interfaces]

    @property
    def share(self) -> Path:
        """The directory of the definitions, .idl files and type descriptions."""
        return self.output / "share" / self.name

    def description(self, idl: str) -> Path:
        """The file with the type description (JSON, with the type hashes) of an interface."""
        return self.share / Path(idl).with_suffix(".json")

    @property
    def include(self) -> Path:
        """The directory of the C and C++ sources."""
        return self.output / "include" / self.name

    @property
    def introspection(self) -> Path:
        """The directory of the introspection sources: some have the same file names as those in include."""
        return self.output / "introspection" / self.name

    @property
    def python(self) -> Path:
        """The directory of the importable package."""
        return self.output / "python" / self.name

    @property
    def library(self) -> Path:
        """The shared object that holds all compiled code of the package."""
        return self.python / f"{self.name}_s__{DISPATCHER}.so"

    def beside(self, name: str) -> "Package":
        """Another package in the same output directory. It has been generated if its share/ exists."""
        return Package(name, self.source.parent / name, self.output)


def generate(package: Package) -> list[str]:
    """Write all sources of a package and return the packages that it must be linked with.

    Raises:
        BuildError: there is no definition file, or one uses a package that is not installed.
    """
    if not package.interfaces:
        raise BuildError(f"{package.name} has no .msg, .srv or .action file under {package.source}.")
    cache_parsing()
    _write_idls(package)
    _require_used_packages(package)
    _write_descriptions(package)
    _write_sources(package)
    _write_visibility_headers(package)
    _write_index(package)
    return _dependencies(package)


def _write_idls(package: Package) -> None:
    from rosidl_adapter import convert_to_idl

    for interface in package.interfaces:
        target = package.share / interface
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(package.source / interface, target)
        convert_to_idl(package.source, package.name, Path(interface), package.share)


def _used_packages(package: Package) -> set[str]:
    texts = (package.share.joinpath(idl).read_text(encoding="utf-8") for idl in package.idls)
    return {used for text in texts for used in re.findall(r'#include "(\w+)/', text)} - {package.name}


def _require_used_packages(package: Package) -> None:
    lib = ros_prefix() / "lib"
    # A wheel provides a library; packages that were built here and installed have definitions there as well.
    used = sorted(_used_packages(package))
    in_wheels = {name for name in used if (lib / f"lib{name}__{GENERATOR_C}.so").exists()}
    missing = [name for name in used if name not in in_wheels and not package.beside(name).share.exists()]
    if missing:
        raise BuildError(
            f"{package.name} uses {', '.join(missing)}, which no installed ROS wheel provides and which is "
            "not built before it."
        )


def _arguments(package: Package, generator: str, output: Path, **more: object) -> str:
    """Write a generator's argument file, as CMake would, and return its path."""
    output.mkdir(parents=True, exist_ok=True)
    path = package.output / f"{generator}.json"
    arguments = {
        "package_name": package.name,
        "output_dir": str(output),
        "template_dir": str(ros_prefix() / "share" / generator / "resource"),
        "idl_tuples": [f"{package.share}:{idl}" for idl in package.idls],
        "target_dependencies": [],
        **more,
    }
    path.write_text(json.dumps(arguments), encoding="utf-8")
    return str(path)


def _write_descriptions(package: Package) -> None:
    from rosidl_generator_type_description import generate_type_hash

    shares = (ros_prefix() / "share", package.share.parent)
    found = (path.parent for share in shares for kind in KINDS for path in share.glob(f"*/{kind}"))
    # Later ones replace earlier ones: the current files come before an installed build of the package.
    described = {path.name: path for path in found}
    include_paths = [f"{name}:{described[name]}" for name in sorted(described) if name != package.name]
    generate_type_hash(_arguments(package, DESCRIPTION, package.share, include_paths=include_paths))
    # Actions and services also leave a description of each part; upstream ships the whole ones only.
    whole = {package.description(idl) for idl in package.idls}
    for description in set(package.share.rglob("*.json")) - whole:
        description.unlink()


def _write_sources(package: Package) -> None:
    from rosidl_generator_c import generate_c
    from rosidl_generator_py.generate_py_impl import generate_py
    from rosidl_typesupport_c import generate_c as generate_dispatcher
    from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c
    from rosidl_typesupport_introspection_c import generate_c as generate_introspection

    definitions = {
        "ros_interface_files": [str(package.share / interface) for interface in package.interfaces],
        "type_description_tuples": [f"{idl}:{package.description(idl)}" for idl in package.idls],
    }
    jobs = [
        (generate_c, _arguments(package, GENERATOR_C, package.include, **definitions)),
        (generate_typesupport_fastrtps_c, _arguments(package, FASTRTPS, package.include)),
        (generate_py, _arguments(package, GENERATOR_PY, package.python), [DISPATCHER]),
        (generate_introspection, _arguments(package, INTROSPECTION, package.introspection)),
        (generate_dispatcher, _arguments(package, DISPATCHER, package.include), [FASTRTPS, INTROSPECTION]),
    ]
    for job, *arguments in jobs:
        job(*arguments)
    (package.python / "__init__.py").touch()


def _write_visibility_headers(package: Package) -> None:
    for generator in (GENERATOR_C, FASTRTPS, INTROSPECTION):
        header = package.include / "msg" / f"{generator}__visibility_control.h"
        template = ros_prefix() / "share" / generator / "resource" / f"{header.name}.in"
        text = template.read_text(encoding="utf-8").replace("@PROJECT_NAME_UPPER@", package.name.upper())
        header.parent.mkdir(parents=True, exist_ok=True)
        header.write_text(text.replace("@PROJECT_NAME@", package.name), encoding="utf-8")


def _write_index(package: Package) -> None:
    """Register the package in the ament index, which get_package_share_directory() and other tools read."""
    index = package.output / "share" / "ament_index" / "resource_index"
    content = {"packages": "", "rosidl_interfaces": "\n".join(sorted(package.interfaces + package.idls))}
    for kind, text in content.items():
        (index / kind).mkdir(parents=True, exist_ok=True)
        (index / kind / package.name).write_text(text, encoding="utf-8")


def _dependencies(package: Package) -> list[str]:
    used = _used_packages(package)
    # Services have events, and actions have goal ids and cancellation, which the definitions don't mention.
    kinds = {idl.split("/")[0] for idl in package.idls}
    if kinds & {"srv", "action"}:
        used |= {"service_msgs", "builtin_interfaces"}
    if "action" in kinds:
        used |= {"action_msgs", "unique_identifier_msgs"}
    return sorted(used)
