"""ros2 pkg create: its output, and every file that it writes."""

import shlex
from pathlib import Path

import pytest
from catkin_pkg.package import parse_package

from sim.ros2 import parser

EXPECTED = Path(__file__).with_name("new_packages.txt")
COMMANDS = [
    "create --build-type ament_python --license Apache-2.0 --node-name talker my_pkg --dependencies rclpy",
    "create cpp_pkg --node-name hello --dependencies rclpy --description 'Says <hello>' --package-format 2",
    "create --build-type ament_python --node-name same --library-name same bare_pkg --license MIT",
    "create my_interfaces",
]
WHO = " --maintainer-name Ada --maintainer-email ada@home.org"


def execute(line: str) -> tuple[int, str]:
    """The status and the output of `ros2 pkg ...`."""
    lines: list[str] = []
    status = parser.execute(
        parser.make_parser(), ["pkg", *shlex.split(line)], None, lines.append, lines.append
    )
    return status, "\n".join(lines)


def made(line: str, folder: Path) -> str:
    """A command, its output, and each file that it writes, except the text of a license."""
    status, lines = execute(line + WHO)
    files = {
        path.relative_to(folder).as_posix(): "(…)\n" if path.name == "LICENSE" else path.read_text()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
    listing = "".join(f"--- {name}\n{text}" for name, text in files.items())
    return f"$ ros2 pkg {line}\n{lines.replace(str(folder), '~')}\n({status})\n{listing}"


def test_the_output_and_the_files_are_as_expected(tmp_path, monkeypatch):
    texts = []
    for number, line in enumerate(COMMANDS):
        folder = tmp_path / str(number)
        folder.mkdir()
        monkeypatch.chdir(folder)
        texts.append(made(line, folder))
    assert "\n".join(texts) == EXPECTED.read_text()


def test_catkin_reads_every_package_xml(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert [execute(line)[0] for line in COMMANDS] == [0, 0, 0, 0]
    read = {name: parse_package(str(tmp_path / name)) for name in ("my_pkg", "cpp_pkg", "bare_pkg")}
    assert [str(one) for one in read["my_pkg"].build_depends] == ["rclpy"]
    assert read["cpp_pkg"].description == "Says &lt;hello&gt;"  # as markup
    assert {one.get_build_type() for one in read.values()} == {"ament_python", "ament_cmake"}


def test_a_license_that_the_course_has_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    execute(COMMANDS[0])
    assert "Apache License" in (tmp_path / "my_pkg" / "LICENSE").read_text()
    execute(COMMANDS[3])
    assert not (tmp_path / "my_interfaces" / "LICENSE").exists()


@pytest.mark.parametrize(
    ("line", "status", "complaint"),
    [
        (
            "create there",
            1,
            "\nAborted!\nThe directory already exists: ./there\nEither remove the directory or choose a "
            "different destination directory or package name",
        ),
        (
            "create --build-type ament_python test",
            1,
            "Aborted since 'ament_python' packages can't be named 'test'. Please choose a different "
            "package name.",
        ),
        (
            "create mine --library-name part",
            1,
            "--library-name makes a library in C++, which is not supported here: leave it out.",
        ),
        (
            "create mine --destination-directory there/file",
            1,
            "unable to create folder: there/file/mine: Not a directory",
        ),
        ("create mine --build-type ament_pyton", 2, "Did you mean ament_python?"),
    ],
)
def test_a_package_that_can_t_be_created_is_refused(tmp_path, monkeypatch, line, status, complaint):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "file").touch()
    environment = execute(line)
    assert (environment[0], environment[1].endswith(complaint)) == (status, True), environment


def test_the_default_email_address_is_git_s(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "git").write_text("[user]\nemail = eve@home.org\n")
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(tmp_path / "git"))
    monkeypatch.setenv("GIT_CONFIG_SYSTEM", "/dev/null")
    assert "<eve@home.org>" in execute("create one --maintainer-name Eve")[1]
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "<Eve@todo.todo>" in execute("create two --maintainer-name Eve")[1]
