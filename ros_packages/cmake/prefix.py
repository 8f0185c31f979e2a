"""Makes a virtual environment a ROS prefix, as /opt/ros/jazzy is one.

    python ros_packages/cmake/prefix.py      run by the environment's Python

The ROS wheels provide all that colcon, CMake and ament need, except for three things: AMENT_PREFIX_PATH isn't
set, a workspace can't source its underlay, and the CMake files contain folders of the machine that built the
wheels. Besides, find_package finds the packages in ros_packages/, and explains those that the course lacks.
"""

import importlib.util
import re
import shutil
import sys
import sysconfig
import tomllib
from collections.abc import Iterator
from pathlib import Path

SHELLS = ("sh", "bash", "zsh")
CMAKE = Path(__file__).resolve().parent
# On the path itself, as with ROS: a folder launch/ in a package would hide an editable install's import hook.
PACKAGES = CMAKE.with_name("python")
PTH = f"{PACKAGES}\nimport os, sys; os.environ.setdefault('AMENT_PREFIX_PATH', sys.prefix); "
# Packages written for older versions of CMake build without a warning, as with ROS's own.
PTH += "os.environ.setdefault('CMAKE_POLICY_VERSION_MINIMUM', '3.10')\n"
# Every workspace sources this first: the prefix was in AMENT_PREFIX_PATH when the workspace was built.
SETUP = """\
case ":$AMENT_PREFIX_PATH:" in
    *:"{prefix}":*) ;;
    *) export AMENT_PREFIX_PATH="{prefix}${{AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}}" ;;
esac
case ":$PATH:" in
    *:"{prefix}/bin":*) ;;
    *) export PATH="{prefix}/bin:$PATH" ;;
esac
"""
DEFINITIONS = CMAKE.with_name("interfaces") / "definitions"
ABSENT = "absent_packages.toml"  # of sim
WRITTEN_HERE = "# Written by the course's set-up."
EMPTY_CONFIG = "{written}\nset({package}_FOUND_AMENT_PACKAGE TRUE)\n"
INTERFACES_CONFIG = """\
{written}
set({package}_FOUND_AMENT_PACKAGE TRUE)
if(CMAKE_CXX_COMPILER AND NOT TARGET {package}::{package})
  foreach(_dependency {dependencies})
    find_package(${{_dependency}} REQUIRED)
    foreach(_kind __rosidl_generator_c __rosidl_generator_cpp __rosidl_typesupport_introspection_c)
      list(APPEND _{package}_targets ${{${{_dependency}}_TARGETS${{_kind}}}})
    endforeach()
    list(APPEND {package}_RECURSIVE_DEPENDENCIES ${{_dependency}})
    list(APPEND {package}_RECURSIVE_DEPENDENCIES ${{${{_dependency}}_RECURSIVE_DEPENDENCIES}})
  endforeach()
  list(REMOVE_DUPLICATES {package}_RECURSIVE_DEPENDENCIES)
  include("{folder}/course_interfaces.cmake")
  course_interfaces({package} "{python}" "{generator}" "{library}" ${{_{package}_targets}})
endif()
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH TRUE)
set({package}_IDL_FILES "{idls}")
set({package}_INTERFACE_FILES "{interfaces}")
set({package}_TARGETS {package}::{package})
foreach(_kind generator_c generator_cpp typesupport_c typesupport_cpp
        typesupport_fastrtps_c typesupport_fastrtps_cpp
        typesupport_introspection_c typesupport_introspection_cpp)
  set({package}_TARGETS__rosidl_${{_kind}} {package}::{package})
endforeach()
"""
ABSENT_CONFIG = """\
{written}
if({package}_FIND_REQUIRED)
  message(FATAL_ERROR "{reason}")
endif()
set({package}_FOUND FALSE)
"""
CPP_CONFIG = """\
{written}
if({package}_FIND_REQUIRED AND NOT TARGET {package}::{package})
  include("{folder}/cpp_packages.cmake")
  cpp_package({package} "{about}")
endif()
set({package}_FOUND_AMENT_PACKAGE TRUE)
if(NOT {package}_FIND_REQUIRED)
  set({package}_FOUND FALSE)
endif()
"""
OTHER = (
    "{package} ({about}) is a ROS package that the course does not include. Remove its find_package if "
    "nothing here uses it."
)
ROS1 = "{package} is a package of ROS 1. ROS 2 has {instead}."
BUILD_FOLDERS = re.compile(r"/opt/python/cp\d+-cp\d+/(include/python3\.\d+|lib/python3\.\d+/site-packages)")


def write_setup_files(prefix: Path) -> None:
    """Write ros.pth, which every Python of the environment reads, and the scripts that workspaces source."""
    packages = Path(sysconfig.get_path("purelib"))
    (packages / "ros.pth").write_text(PTH)
    for shell in SHELLS:
        (prefix / f"local_setup.{shell}").write_text(SETUP.format(prefix=prefix))


def correct_folders(prefix: Path) -> None:
    """Replace the folders in the wheels' CMake files by those of this Python."""
    folders = {"include": sysconfig.get_path("include"), "lib": sysconfig.get_path("purelib")}
    for path in prefix.glob("share/*/cmake/*.cmake"):
        text = path.read_text(encoding="utf-8")
        corrected = BUILD_FOLDERS.sub(lambda found: folders[found[1].split("/")[0]], text)
        if corrected != text:
            # Not in place: the file may be a link to uv's cache.
            partial = path.with_name(f"{path.name}.part")
            partial.write_text(corrected, encoding="utf-8")
            partial.replace(path)


def write_cmake_packages(prefix: Path) -> None:
    """Let find_package find the course's packages, and say what those are that the course lacks."""
    for package, text in [*_explanations(), *_empty_packages(), *_interface_packages()]:
        write_cmake_config(prefix, package, text)
    for folder in (config.parent for config in CMAKE.glob("*/*Config.cmake")):
        shutil.copytree(folder, prefix / "share" / folder.name / "cmake", dirs_exist_ok=True)


def write_cmake_config(prefix: Path, package: str, text: str) -> None:
    """Write what find_package reads, unless a wheel brought it."""
    config = prefix / "share" / package / "cmake" / f"{package}Config.cmake"
    if not config.is_file() or config.read_text(encoding="utf-8").startswith(WRITTEN_HERE):
        config.parent.mkdir(parents=True, exist_ok=True)
        config.write_text(text, encoding="utf-8")


def _empty_packages() -> Iterator[tuple[str, str]]:
    """Packages that are found and give CMake nothing, with their configurations."""
    names = [path.name for path in PACKAGES.iterdir() if path.is_dir()]
    names += (CMAKE / "empty.txt").read_text(encoding="utf-8").splitlines()[1:]
    for package in names:
        yield package, EMPTY_CONFIG.format(written=WRITTEN_HERE, package=package)


def _interface_packages() -> Iterator[tuple[str, str]]:
    """The course's interface packages, with their configurations."""
    modules = sysconfig.get_path("purelib")
    for folder in sorted(DEFINITIONS.iterdir()):
        files = [path.relative_to(folder) for path in sorted(folder.glob("*/*.*"))]
        yield (
            folder.name,
            INTERFACES_CONFIG.format(
                written=WRITTEN_HERE,
                package=folder.name,
                dependencies=" ".join(_used_packages(folder)),
                folder=CMAKE,
                python=sys.executable,
                generator=DEFINITIONS.parent / "headers.py",
                library=Path(modules, folder.name, f"{folder.name}_s__rosidl_typesupport_c.so"),
                idls=";".join(str(path.with_suffix(".idl")) for path in files),
                interfaces=";".join(map(str, files)),
            ),
        )


def _used_packages(folder: Path) -> list[str]:
    """The packages whose messages an interface package uses."""
    files = list(folder.glob("*/*.*"))
    kinds = {path.parent.name for path in files}
    used = {"service_msgs", "builtin_interfaces"} if kinds & {"srv", "action"} else set()
    used |= {"action_msgs", "unique_identifier_msgs"} if "action" in kinds else set()
    for path in files:
        used |= set(re.findall(r"^\s*(\w+)/\w+", path.read_text(encoding="utf-8"), re.MULTILINE))
    return sorted(used - {folder.name})


def _explanations() -> Iterator[tuple[str, str]]:
    """Packages that the course lacks, with configurations that say so in a sentence."""
    (sim,) = importlib.util.find_spec("sim").submodule_search_locations
    table = tomllib.loads(Path(sim, ABSENT).read_text(encoding="utf-8"))
    cpp = {package: row["about"] for package, row in table["ros"].items() if row.get("cpp")}
    for package, about in cpp.items():
        yield package, CPP_CONFIG.format(written=WRITTEN_HERE, package=package, about=about, folder=CMAKE)
    reasons = {
        package: OTHER.format(package=package, about=row["about"])
        for package, row in table["ros"].items()
        if package not in cpp
    }
    reasons |= {package: ROS1.format(package=package, instead=row) for package, row in table["ros1"].items()}
    for package, reason in reasons.items():
        yield package, ABSENT_CONFIG.format(written=WRITTEN_HERE, package=package, reason=reason)


def main() -> None:
    """Make the environment of this Python a ROS prefix."""
    prefix = Path(sys.prefix)
    write_setup_files(prefix)
    correct_folders(prefix)
    write_cmake_packages(prefix)


if __name__ == "__main__":
    main()
