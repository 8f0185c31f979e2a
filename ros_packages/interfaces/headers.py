"""Generates headers, for CMake packages that use an interface package: headers.py PACKAGE OUTPUT"""

import json
import sys
from pathlib import Path

from build_tools.generate import Package, generate
from build_tools.toolchain import ros_prefix

CPP = "rosidl_generator_cpp"
DEFINITIONS = Path(__file__).resolve().parent / "definitions"


def write_headers(package: Package) -> None:
    """Write the headers that C and C++ sources of other packages include."""
    from rosidl_generator_cpp import generate_cpp

    generate(package)
    arguments = {
        "package_name": package.name,
        "output_dir": str(package.include),
        "template_dir": str(ros_prefix() / "share" / CPP / "resource"),
        "idl_tuples": [f"{package.share}:{idl}" for idl in package.idls],
        "target_dependencies": [],
        "ros_interface_files": [str(package.share / interface) for interface in package.interfaces],
        "type_description_tuples": [f"{idl}:{package.description(idl)}" for idl in package.idls],
    }
    path = package.output / f"{CPP}.json"
    path.write_text(json.dumps(arguments), encoding="utf-8")
    generate_cpp(str(path))
    header = package.include / "msg" / f"{CPP}__visibility_control.hpp"
    template = ros_prefix() / "share" / CPP / "resource" / f"{header.name}.in"
    text = template.read_text(encoding="utf-8").replace("@PROJECT_NAME_UPPER@", package.name.upper())
    header.write_text(text.replace("@PROJECT_NAME@", package.name), encoding="utf-8")


if __name__ == "__main__":
    name, output = sys.argv[1:]
    write_headers(Package(name, DEFINITIONS / name, Path(output).resolve()))
