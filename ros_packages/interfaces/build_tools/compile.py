"""Compiles each generated package into one shared object, which rclpy imports."""

import re
import shlex
import subprocess
import sys
import sysconfig
from collections.abc import Iterable
from concurrent.futures import Executor, Future
from pathlib import Path

from build_tools.generate import DISPATCHER, FASTRTPS, GENERATOR_C, GENERATOR_PY, INTROSPECTION, Package
from build_tools.toolchain import BuildError, ros_prefix

HERE = Path(__file__).resolve().parent
# -O0, as colcon builds students' packages: the time of a message is mostly spent on Python objects.
# NDEBUG as in the released ROS wheels: without it a wrong field type aborts the interpreter.
FLAGS = ("-O0", "-g0", "-fPIC", "-w", "-DNDEBUG")
STABLE_ABI = ("-DPy_LIMITED_API=0x030B0000", "-include", str(HERE / "stable_abi.h"))
PARTS = (GENERATOR_C, FASTRTPS, INTROSPECTION, DISPATCHER, GENERATOR_PY)  # one library each in a ROS wheel
STATIC = re.compile(r"^static .*?\b(\w+)(?:\[\])? =", re.MULTILINE)
INTERFACES_PER_UNIT = 12  # few enough to use several cores, many enough to share the parsing of headers
RUNTIME = (*PARTS[1:4], f"{FASTRTPS}pp", "rosidl_runtime_c", "rcutils", "rmw", "fastcdr")


def compiling(package: Package, pool: Executor) -> list[Future[Path]]:
    """Start to compile a package that generate() has written."""
    objects = package.output / "objects" / package.name
    objects.mkdir(parents=True, exist_ok=True)
    entry_point = package.python / f"_{package.name}_s.ep.{DISPATCHER}.c"
    units = [*_units(package, objects), entry_point, HERE / "dispatch.cpp"]
    flags = _flags(package)
    return [pool.submit(_compile, unit, objects, flags) for unit in units]


def link(package: Package, dependencies: Iterable[str], compiled: Iterable[Future[Path]]) -> Path:
    """Link a compiled package, check that it can be loaded, and return the shared object.

    Args:
        package: a package that generate() has written.
        dependencies: the packages to link with, as generate() returned them.
        compiled: the result of compiling().

    Raises:
        BuildError: the compiler, the linker or the loader failed; the message contains its output.
    """
    objects = [unit.result() for unit in compiled]
    _run(["g++", "-shared", "-s", "-o", package.library, *objects, *_link_flags(package, dependencies)])
    _check_loads(package.library)
    return package.library


def _units(package: Package, directory: Path) -> list[Path]:
    """Write the files to compile. Each includes several generated files, which share the same headers."""
    from rosidl_pycommon import convert_camel_case_to_lower_case_underscore

    units: dict[str, str] = {}
    for number, idl in enumerate(map(Path, package.idls)):
        kind, name = idl.parent, convert_camel_case_to_lower_case_underscore(idl.stem)
        detail = package.include / kind / "detail"
        c = [
            detail / f"{name}__functions.c",
            detail / f"{name}__type_support.c",
            package.introspection / kind / "detail" / f"{name}__type_support.c",
            package.python / kind / f"_{name}_s.c",
        ]
        cpp = [detail / f"{name}__type_support_c.cpp", package.include / kind / f"{name}__type_support.cpp"]
        described = _include_with_unique_names(detail / f"{name}__description.c", number)
        for suffix, text in (("c", _include(*c) + described), ("cpp", _include(*cpp))):
            unit = f"{number // INTERFACES_PER_UNIT}.{suffix}"
            units[unit] = units.get(unit, "") + text
    for unit, text in units.items():
        (directory / unit).write_text(text, encoding="utf-8")
    # The longest first, so that no core idles at the end.
    return [directory / unit for unit in sorted(units, key=lambda unit: -len(units[unit]))]


def _include(*files: Path) -> str:
    return "".join(f'#include "{file}"\n' for file in files)


def _include_with_unique_names(description: Path, number: int) -> str:
    """Include the description of a type, with its static names made unique within the unit."""
    names = STATIC.findall(description.read_text(encoding="utf-8"))
    defined = "".join(f"#define {name} {name}__{number}\n" for name in names)
    return defined + _include(description) + "".join(f"#undef {name}\n" for name in names)


def _flags(package: Package) -> list[str]:
    import numpy

    ros = ros_prefix() / "include"
    includes = [
        package.include.parent,
        package.introspection.parent,
        ros,
        *sorted(path for path in ros.iterdir() if path.is_dir()),
        sysconfig.get_path("include"),
        numpy.get_include(),
    ]
    dispatcher = f"-D{DISPATCHER}__get_{{0}}_typesupport_handle_function=dispatch_{{0}}"
    redirect = [dispatcher.format(kind) for kind in ("message", "service")]
    # Error messages contain source paths; the map removes the build directory from them.
    return [*FLAGS, *redirect, f"-ffile-prefix-map={package.output}=.", *(f"-I{path}" for path in includes)]


def _compile(unit: Path, directory: Path, flags: list[str]) -> Path:
    compiled = directory / f"{unit.name}.o"
    compiler = ["g++", "-std=c++17"] if unit.suffix == ".cpp" else ["gcc", "-std=gnu11", *STABLE_ABI]
    _run([*compiler, *flags, "-c", unit, "-o", compiled])
    return compiled


def _link_flags(package: Package, dependencies: Iterable[str]) -> list[str]:
    built = [other for other in map(package.beside, dependencies) if other.library.exists()]
    in_wheels = set(dependencies) - {other.name for other in built}
    libraries = [f"{name}__{part}" for name in sorted(in_wheels) for part in PARTS]
    lib = ros_prefix() / "lib"
    return [
        f"-Wl,-soname,{package.library.name}",
        "-Wl,--as-needed",
        *(str(other.library) for other in built),
        *(f"-Wl,-rpath,$ORIGIN/../{other.name}" for other in built),
        # From site-packages/PACKAGE to lib/ of the environment, which may be moved.
        "-Wl,-rpath,$ORIGIN/../../..",
        f"-L{lib}",
        *(f"-l{library}" for library in (*libraries, *RUNTIME)),
        "-ldl",
    ]


def _check_loads(library: Path) -> None:
    """Load the shared object in another process, to report a missing symbol now and by its name."""
    _run([sys.executable, "-c", "import ctypes, os, sys; ctypes.CDLL(sys.argv[1], os.RTLD_NOW)", library])


def _run(command: Iterable[object]) -> None:
    arguments = [str(argument) for argument in command]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    if done.returncode:
        shown = shlex.join(arguments)
        raise BuildError(f"This step of the interface build failed:\n{shown}\n{done.stderr.strip()}")
