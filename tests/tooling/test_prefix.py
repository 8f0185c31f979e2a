"""ros_packages/cmake/prefix.py makes an environment a ROS prefix for colcon and CMake."""

import os
import subprocess
import sys
import sysconfig

import pytest

from tests.tooling.test_ci import ROOT, load

prefix = load("prefix.py", "ros_packages/cmake")
BUILD_FOLDERS = "/opt/python/cp311-cp311"
WHEELS = f'INCLUDE "{BUILD_FOLDERS}/include/python3.11;{BUILD_FOLDERS}/lib/python3.11/site-packages/x"\n'


@pytest.fixture
def environment(tmp_path, monkeypatch):
    packages = tmp_path / "packages"
    packages.mkdir()
    folders = {"purelib": str(packages), "include": sysconfig.get_path("include")}
    monkeypatch.setattr(sysconfig, "get_path", folders.__getitem__)
    return tmp_path


def test_the_wheels_cmake_files_get_this_pythons_folders_and_a_linked_file_is_not_changed(environment):
    folder = environment / "share/geometry_msgs/cmake"
    folder.mkdir(parents=True)
    (folder / "cached.txt").write_text(WHEELS)
    (folder / "export.cmake").hardlink_to(folder / "cached.txt")
    (folder / "plain.cmake").write_text("nothing")
    prefix.correct_folders(environment)
    here = f"{sysconfig.get_path('include')};{environment}/packages/x"
    assert (folder / "export.cmake").read_text() == f'INCLUDE "{here}"\n'
    assert (folder / "cached.txt").read_text() == WHEELS
    assert {path.name for path in folder.iterdir()} == {"cached.txt", "export.cmake", "plain.cmake"}


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_the_script_that_workspaces_source_sets_the_prefix_once(environment, shell):
    prefix.write_setup_files(environment)
    script = environment / f"local_setup.{shell}"
    twice = f'. "{script}"; . "{script}"; echo "$AMENT_PREFIX_PATH $PATH"'
    output = subprocess.check_output([shell, "-c", twice], env={"PATH": os.environ["PATH"]}, text=True)
    assert output == f"{environment} {environment}/bin:{os.environ['PATH']}\n"


def test_every_python_of_the_environment_sets_the_prefix(environment, monkeypatch):
    prefix.write_setup_files(environment)
    packages, line = (environment / "packages/ros.pth").read_text().splitlines()
    assert packages == str(ROOT / "ros_packages/python")
    monkeypatch.delenv("AMENT_PREFIX_PATH")
    exec(line)
    assert os.environ["AMENT_PREFIX_PATH"] == sys.prefix
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/opt/ros/jazzy")
    exec(line)
    assert os.environ["AMENT_PREFIX_PATH"] == "/opt/ros/jazzy"
