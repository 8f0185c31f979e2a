"""Packages that colcon built, as programs of a run."""

import subprocess
import sys
from pathlib import Path

import pytest

from sim import Process, executable, run, source
from sim.ros import packages
from tests.sim.ros.workspaces import BEEP, as_it_was, build, with_programs


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    """A built and sourced workspace; the environment is restored afterwards."""
    folder = tmp_path_factory.mktemp("ws")
    with_programs(folder)
    with as_it_was():
        build(folder, "--symlink-install")
        source(folder / "install" / "setup.bash")
        yield folder


def logged(target, **more):
    recording = run(target, seconds=1.2, quiet=True, **more)
    assert recording.errors == []
    return [received.message.data for received in recording.messages("/chatter")]


def test_an_entry_point_is_a_program_and_reads_its_files_again_each_time(workspace):
    talker = executable("my_pkg", "talker")
    assert talker.__name__ == "talker"
    assert logged(talker) == ["hello", "hello"]
    (workspace / "src/my_pkg/my_pkg/words.py").write_text("HELLO = 'good evening'\n")
    assert logged(talker) == ["good evening", "good evening"]


def test_it_takes_the_settings_of_a_process(workspace):
    node = Process(executable("my_pkg", "talker"), name="caller", namespace="/up")
    recording = run(node, seconds=1, quiet=True)
    assert [end.node for end in recording.graph.publishers() if end.name == "/up/chatter"] == ["/up/caller"]


def test_a_script_finds_the_modules_beside_it(workspace):
    recording = run(executable("my_pkg", "beep"), seconds=1, quiet=True)
    assert "".join(text for _, text in recording.prints) == "beep at 440 Hz\n"


def test_the_programs_of_a_package_are_known(workspace):
    assert packages.executables("my_pkg") == ["beep", "shell", "talker"]
    assert packages.executables("lost") == []
    assert {"my_pkg", "lost", "rclpy"} <= set(packages.packages())
    assert packages.prefix_of("my_pkg") == workspace / "install/my_pkg"


@pytest.mark.parametrize(
    ("package", "name", "why"),
    [
        (
            "my_pkg",
            "talkr",
            "my_pkg has beep, shell, talker, but no talkr. Did you mean talker? "
            "Changes in 'console_scripts' of setup.py take effect after the next colcon build.",
        ),
        (
            "my_pkg",
            "x",
            "my_pkg has beep, shell, talker, but no x. "
            "Changes in 'console_scripts' of setup.py take effect after the next colcon build.",
        ),
        (
            "my_pkg",
            "shell",
            "shell of my_pkg is not a Python program. A run starts only those; ros2 run starts it.",
        ),
        (
            "lost",
            "stray",
            "stray was installed into bin, not into lib/lost. "
            "In setup.cfg, [install] must set install_scripts=$base/lib/lost.",
        ),
        ("lost", "x", "lost has none. Name one in 'console_scripts' of its setup.py, and build it again."),
    ],
)
def test_a_missing_program_is_explained(workspace, package, name, why):
    with pytest.raises(packages.ExecutableNotFound) as caught:
        executable(package, name)
    assert str(caught.value) == f"No executable found: {why}"


@pytest.mark.parametrize(
    ("package", "name", "why"),
    [
        (
            "turtlesim",
            "turtle_teleop_key",
            "arrow keys drive turtle1 on the page of `ros2 run turtlesim turtlesim_node`, and in play(...).",
        ),
        ("tf2_tools", "view_frames", "plot_frames(recording) of sim.view draws the tree of frames."),
        (
            "tf2_ros",
            "tf2_ech",
            "tf2_ros has static_transform_publisher, tf2_echo, but no tf2_ech. Did you mean tf2_echo?",
        ),
    ],
)
def test_a_tutorial_program_that_is_not_bundled_is_explained(package, name, why):
    with pytest.raises(packages.ExecutableNotFound) as caught:
        executable(package, name)
    assert str(caught.value) == f"No executable found: {why}"


def test_a_terminal_starts_the_pond_in_its_own_domain(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    assert packages.executables("turtlesim") == ["mimic", "turtlesim_node"]
    assert packages.command_of("turtlesim", "turtlesim_node") == [
        sys.executable, "-m", "sim", "--world", "turtlesim", "--domain", "7",
    ]  # fmt: skip


def reason(package):
    with pytest.raises(packages.PackageNotFound) as caught:
        executable(package, "x")
    return str(caught.value)


def test_a_missing_package_is_explained(workspace, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    begin = "Package 'my_pgk' not found: "
    assert reason("my_pgk") == f"{begin}did you mean my_pkg?"
    nowhere = "no package.xml has that name in a workspace here, and no workspace that has it was sourced."
    assert reason("zzz") == f"Package 'zzz' not found: {nowhere}"
    monkeypatch.chdir(workspace.parent)
    monkeypatch.setenv("AMENT_PREFIX_PATH", sys.prefix)
    at = workspace.name
    script = f"{at}/install/setup.bash"
    both = f"`source {script}` in a terminal, `source('{script}')` in a notebook"
    here = f"it is built but not sourced: {both}."
    assert reason("my_pkg") == f"Package 'my_pkg' not found: {here}"


VALID = """\
<package format="3">
  <name>{}</name><version>0.0.0</version><description>d</description>
  <maintainer email="me@example.com">me</maintainer><license>MIT</license>
  <export><build_type>ament_python</build_type></export>
</package>
"""


def test_a_package_that_was_not_built_is_found_by_its_package_xml(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, text in {"fresh": VALID.format("fresh"), "broken": "<package>"}.items():
        (tmp_path / "ws/src" / name).mkdir(parents=True)
        (tmp_path / "ws/src" / name / "package.xml").write_text(text)
    what = "it is in ws/src but not built: run colcon build in ws."
    assert reason("fresh") == f"Package 'fresh' not found: {what}"


def test_a_workspace_above_the_current_folder_is_named_in_full(tmp_path, monkeypatch):
    (tmp_path / "ws/src/fresh").mkdir(parents=True)
    (tmp_path / "ws/src/fresh/package.xml").write_text(VALID.format("fresh"))
    monkeypatch.chdir(tmp_path / "ws/src/fresh")
    what = f"it is in {tmp_path}/ws/src but not built: run colcon build in {tmp_path}/ws."
    assert reason("fresh") == f"Package 'fresh' not found: {what}"


def test_what_cannot_be_sourced_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError) as caught:
        source(tmp_path / "setup.bash")
    where = tmp_path / "setup.bash"
    assert str(caught.value) == f"There is no {where}: colcon build in the workspace creates it."
    where.write_text("echo it is broken >&2\nreturn 1\n")
    with pytest.raises(RuntimeError) as failed:
        source(where)
    assert str(failed.value) == f"bash can't source {where}: it is broken"


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """A function that makes a package with files in lib/PACKAGE (name to text and mode), and its folder."""

    def install(package, files, *folders):
        prefix = tmp_path / "install"
        for folder in (packages.INDEX + "/packages", f"lib/{package}", *folders):
            (prefix / folder).mkdir(parents=True)
        (prefix / packages.INDEX / "packages" / package).write_text("")
        for name, (text, mode) in files.items():
            (prefix / "lib" / package / name).write_text(text)
            (prefix / "lib" / package / name).chmod(mode)
        monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
        return prefix / "lib" / package

    return install


def why_not(package, name):
    with pytest.raises(packages.ExecutableNotFound) as caught:
        packages.command_of(package, name)
    return str(caught.value).removeprefix("No executable found: ")


def test_a_script_that_is_not_executable_is_named(installed):
    installed("mine", {"beep": (BEEP, 0o644), "other": (BEEP, 0o755)})
    assert why_not("mine", "beep") == (
        "beep of mine is not executable. Run chmod +x on its source, or install it with "
        "install(PROGRAMS ...) in CMakeLists.txt, and build it again."
    )


def test_a_cmake_package_has_no_setup_py(installed):
    installed("mine", {}, "share/mine/cmake")
    assert why_not("mine", "beep") == (
        "mine has none. Install one with install(PROGRAMS ... DESTINATION lib/mine) in its CMakeLists.txt, "
        "and build it again."
    )


def test_a_cmake_package_with_other_programs_names_them(installed):
    installed("mine", {"other": (BEEP, 0o755)}, "share/mine/cmake")
    assert why_not("mine", "beep") == (
        "mine has other, but no beep. Changes in CMakeLists.txt take effect after the next colcon build."
    )


def test_a_script_that_setuptools_installed_is_started_by_this_python(installed):
    """Of `scripts=` it writes a copy that begins with #!python, which is no program's path."""
    text = "#!python\nprint('it runs')\n"
    folder = installed("mine", {"hello": (text, 0o755)})
    command = [sys.executable, str(folder / "hello")]
    assert packages.command_of("mine", "hello") == packages.bundled_command("mine", "hello") == command
    recording = run(executable("mine", "hello"), seconds=1, quiet=True)
    assert "".join(text for _, text in recording.prints) == "it runs\n"


def test_a_program_without_an_interpreter_is_refused_in_a_sentence(installed):
    folder = installed("mine", {"beep": ("#!/nowhere/python\n", 0o755)})
    ros2 = Path(sys.executable).with_name("ros2")
    done = subprocess.run([ros2, "run", "mine", "beep"], capture_output=True, text=True, check=False)
    reason = "can't be started: No such file or directory. Check its first line."
    assert (done.returncode, done.stdout, done.stderr) == (1, "", f"{folder}/beep {reason}\n")


def test_a_package_xml_that_cannot_be_read_is_named_even_if_colcon_built_the_package(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ws/src/broken").mkdir(parents=True)
    text = "<package>\n<name>broken</name>\n<depend>a<depend>\n</package>\n"
    (tmp_path / "ws/src/broken/package.xml").write_text(text)
    (tmp_path / "ws/install").mkdir()
    (tmp_path / "ws/install/.colcon_install_layout").write_text("isolated\n")
    index = tmp_path / "ws/install/broken" / packages.INDEX / "packages"
    index.mkdir(parents=True)
    (index / "broken").write_text("")
    assert reason("broken") == (
        "Package 'broken' not found: ws/src/broken/package.xml is not valid: mismatched tag: line 4, column "
        "2. Correct it, and build again."
    )


@pytest.mark.parametrize("line", ["<depend>a<depend>", "<depends>a</depends>"])
def test_a_package_xml_in_a_folder_of_another_name_is_named_if_it_is_not_valid(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "src/folder").mkdir(parents=True)
    (tmp_path / "src/folder/package.xml").write_text(VALID.format("mine").replace("  <export>", line))
    assert reason("mine").startswith("Package 'mine' not found: src/folder/package.xml is not valid: ")


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("<name>mine</name>", "", 'The manifest must contain exactly one "name" tag'),
        ("0.0.0", "1.0", 'Package version "1.0" does not follow version conventions'),
        (' email="me@example.com"', "", 'The "maintainer" tag must have the attribute "email"'),
        ("ament_python", "ament_pyton", "its <export> needs the build_type ament_python or ament_cmake"),
        ("<build_type>ament_python</build_type>", "", "its <export> needs the build_type ament_python or "
         "ament_cmake"),
    ],
)  # fmt: skip
def test_a_package_xml_that_colcon_does_not_accept_is_named(old, new, why, tmp_path, monkeypatch):
    (tmp_path / "src/mine").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "src/mine/package.xml"
    file.write_text(VALID.format("mine"))
    assert reason("mine") == "Package 'mine' not found: it is in src but not built: run colcon build here."
    file.write_text(VALID.format("mine").replace(old, new))
    assert reason("mine") == (
        f"Package 'mine' not found: src/mine/package.xml is not valid: {why}. Correct it, and build again."
    )
