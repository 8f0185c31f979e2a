"""The messages of a build that can't continue, and the equality of two builds."""

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from build_tools import toolchain
from build_tools.compile import compiling, link
from build_tools.generate import Package, generate
from build_tools.toolchain import BuildError, require_compilers, ros_prefix

from tests.patience import PATIENCE

NO_WHEELS = (
    "Building the ROS interfaces needs the ROS wheels, but rosidl_generator_c is missing: "
    "run `pip install 'ros-jazzy-rclpy[fastrtps]' ros-jazzy-common-interfaces` and try again."
)
MISSING = "try_msgs uses {}, which no installed ROS wheel provides and which is not built before it."

STAMPS = "int32 MOST=3\nstd_msgs/Header header\nbuiltin_interfaces/Time[<=3] stamps\nstring<=5 name 'a'\n"
KEPT = (".py", ".so", ".json", ".idl", ".msg")


def needs(missing: str, verb: str, command: str) -> str:
    return (
        f"Building the ROS interfaces needs gcc, g++ and Python.h, but {missing} {verb} missing: "
        f"run `{command}` and try again."
    )


def package(directory: Path, **definitions: str) -> Package:
    """A package whose messages are the keyword arguments, {name: text}."""
    (directory / "source" / "msg").mkdir(parents=True)
    for name, text in definitions.items():
        (directory / "source" / "msg" / f"{name}.msg").write_text(text, encoding="utf-8")
    return Package("try_msgs", directory / "source", directory / "output")


def compiled(package: Package) -> Path:
    """The shared object of a package."""
    with ThreadPoolExecutor(2) as pool:
        return link(package, generate(package), compiling(package, pool))


def command(directory: Path, name: str, script: str) -> None:
    """Replace a program of the machine by a script."""
    program = directory / name
    program.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    program.chmod(0o755)


def test_all_that_a_build_needs_is_found_here():
    require_compilers()
    assert ros_prefix() == Path(sys.prefix)


def test_without_a_compiler_the_build_names_the_packages_to_install(monkeypatch, tmp_path):
    command(tmp_path, "gcc", "exit 0")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    with pytest.raises(BuildError) as stop:
        require_compilers()
    assert str(stop.value) == needs("g++", "is", "sudo apt install build-essential python3-dev")


def test_root_in_a_container_needs_no_sudo(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(toolchain.sysconfig, "get_path", lambda name: str(tmp_path))
    with pytest.raises(BuildError) as stop:
        require_compilers()
    missing = "gcc and g++ and Python.h"
    assert str(stop.value) == needs(missing, "are", "apt install build-essential python3-dev")


def test_without_the_ros_wheels_the_build_says_how_to_install_them(monkeypatch):
    monkeypatch.setattr(toolchain.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(BuildError) as stop:
        ros_prefix()
    assert str(stop.value) == NO_WHEELS


def test_a_package_without_definitions_is_refused(tmp_path):
    empty = package(tmp_path)
    with pytest.raises(BuildError) as stop:
        generate(empty)
    assert str(stop.value) == f"try_msgs has no .msg, .srv or .action file under {tmp_path}/source."


def test_a_definition_that_uses_an_unknown_package_is_refused(tmp_path):
    with pytest.raises(BuildError) as stop:
        generate(package(tmp_path, Lost="lost_msgs/Thing thing\nstd_msgs/Header header\n"))
    assert str(stop.value) == MISSING.format("lost_msgs")


def test_a_definition_that_uses_a_package_that_is_built_later_is_refused_too(tmp_path):
    with pytest.raises(BuildError) as stop:
        generate(package(tmp_path, Early="tf2_msgs/TFMessage transforms\n"))
    assert str(stop.value) == MISSING.format("tf2_msgs")


def test_a_package_may_use_one_that_is_built_before_it(tmp_path):
    first = package(tmp_path / "first", Number="int32 data\n")
    compiled(first)
    second = package(tmp_path / "second", Numbers="try_msgs/Number[] all\n")
    later = Package("use_msgs", second.source, first.output)
    library = compiled(later)
    used = subprocess.run(
        ["ldd", library], capture_output=True, text=True, check=True, timeout=PATIENCE
    ).stdout
    assert str(library.parent / ".." / "try_msgs" / first.library.name) in used


def test_a_failing_compiler_is_quoted_with_its_command(monkeypatch, tmp_path):
    made = package(tmp_path, Number="int32 data\n")
    command(tmp_path, "gcc", "echo no space left >&2; exit 1")
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    with pytest.raises(BuildError) as stop:
        compiled(made)
    first, words, last = str(stop.value).splitlines()
    assert first == "This step of the interface build failed:"
    assert words.startswith("gcc -std=gnu11 -DPy_LIMITED_API=0x030B0000 ")
    assert last == "no space left"


def test_a_library_that_does_not_load_is_refused_with_the_loaders_reason(monkeypatch, tmp_path):
    made = package(tmp_path, Number="int32 data\n")
    # A linker that leaves everything out: the library links, and its first symbol is missing.
    linker = shutil.which("g++")
    lost = f'echo "int lost(); int x = lost();" | {linker} -shared -fPIC -x c++ - -o "$4"'
    command(tmp_path, "g++", f'case "$*" in *-shared*) {lost};; *) exec {linker} "$@";; esac')
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    with pytest.raises(BuildError, match=r"undefined symbol: _Z4lostv$"):
        compiled(made)


def test_the_build_stops_with_the_reason_and_the_package_alone(tmp_path, definitions):
    (tmp_path / "definitions" / "try_msgs").mkdir(parents=True)
    done = build(tmp_path / "definitions", tmp_path / "output")
    assert done.returncode == 1
    reason, package = done.stderr.splitlines()
    assert reason == f"try_msgs has no .msg, .srv or .action file under {tmp_path}/definitions/try_msgs."
    assert package == "The interface package try_msgs could not be built; the reason is above."


def test_a_definition_that_makes_a_generator_exit_is_reported_with_its_package(tmp_path):
    (tmp_path / "definitions").mkdir()
    text = "int32 data  # a path: C:\\\n"
    package(tmp_path / "one", Number=text).source.rename(tmp_path / "definitions" / "try_msgs")
    done = build(tmp_path / "definitions", tmp_path / "output")
    assert done.returncode == 1
    assert "\\ at end of string" in done.stderr
    assert done.stderr.endswith("\nThe interface package try_msgs could not be built; the reason is above.\n")


def test_a_failing_compiler_stops_the_packages_that_come_after(monkeypatch, tmp_path):
    (tmp_path / "definitions").mkdir()
    for name in ("a_msgs", "b_msgs", "c_msgs", "d_msgs"):
        package(tmp_path / name, Number="int32 data\n").source.rename(tmp_path / "definitions" / name)
    broken = 'case "$*" in *a_msgs*) echo no space left >&2; exit 1;; esac'
    command(tmp_path, "gcc", f'{broken}; exec {shutil.which("gcc")} "$@"')
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    done = build(tmp_path / "definitions", tmp_path / "output")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-2:] == [
        "no space left", "The interface package a_msgs could not be built; the reason is above.",
    ]  # fmt: skip
    assert not (tmp_path / "output" / "objects" / "d_msgs").exists()


def build(definitions: Path, output: Path) -> subprocess.CompletedProcess:
    """Build all packages of a folder, as setup.py does."""
    words = [sys.executable, "-m", "build_tools", str(definitions), str(output)]
    tools, seeded = Path(toolchain.__file__).parents[1], {**os.environ, "PYTHONHASHSEED": "0"}
    return subprocess.run(words, cwd=tools, env=seeded, capture_output=True, text=True, timeout=PATIENCE)


@pytest.mark.parametrize("name", ["try_msgs", pytest.param("tf2_msgs", marks=pytest.mark.soak)])
def test_two_builds_in_two_places_are_equal(tmp_path, definitions, name):
    source = definitions / name if name == "tf2_msgs" else package(tmp_path, Stamps=STAMPS).source
    alone = tmp_path / "definitions"
    shutil.copytree(source, alone / name)
    here, there = built(alone, tmp_path / "here"), built(alone, tmp_path / "there")
    assert f"python/{name}/{name}_s__rosidl_typesupport_c.so" in here
    assert here == there


def test_the_cache_of_parsed_files_changes_no_output(tmp_path, definitions):
    upstream = written(definitions / "tf2_msgs", tmp_path / "output", "generate.cache_parsing = lambda: None")
    assert len(upstream) > 60
    assert written(definitions / "tf2_msgs", tmp_path / "output") == upstream


def written(source: Path, output: Path, before: str = "") -> dict[Path, bytes]:
    """The files that a process writes for a package; `before` is done there first."""
    package = f"generate.Package({source.name!r}, Path({str(source)!r}), Path({str(output)!r}))"
    words = (
        f"from build_tools import generate; from pathlib import Path; {before}\ngenerate.generate({package})"
    )
    tools, seeded = Path(toolchain.__file__).parents[1], {**os.environ, "PYTHONHASHSEED": "0"}
    subprocess.run(
        [sys.executable, "-c", words],
        cwd=tools,
        env=seeded,
        check=True,
        capture_output=True,
        timeout=PATIENCE,
    )
    files = {file: file.read_bytes() for file in output.rglob("*.*") if file.is_file()}
    shutil.rmtree(output)
    return files


def built(definitions: Path, place: Path) -> dict[str, bytes]:
    """The files that a process makes of a folder's definitions in this place."""
    place.mkdir()
    assert build(definitions, place).returncode == 0
    files = [file for file in place.glob("[sp]*/**/*.*") if file.suffix in KEPT]
    return {str(file.relative_to(place)): file.read_bytes() for file in files}
