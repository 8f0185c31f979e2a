"""What `make hub ARGS=--check` says of a machine."""
import os
import pwd
import socket
from pathlib import Path
from types import SimpleNamespace

import pytest

from grader.marking.extras.hub import accounts, cli, machine, user_limits
from grader.marking.extras.hub.hub_settings import HubCourse, HubSettings, ServerSettings, UserLimits


def settings(**server: object) -> HubSettings:
    server = {"port": 41_000} | server
    return HubSettings(ServerSettings(**server), UserLimits(), {"ros2": HubCourse(("ines",), ("alice",))})


@pytest.fixture
def complete(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """A machine that has everything; a test takes something away."""
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setattr(machine.shutil, "which", lambda command: f"/usr/bin/{command}")
    monkeypatch.setattr(machine, "find_python", lambda: "/usr/bin/python3")
    monkeypatch.setattr(machine, "PAM", Path("/"))
    monkeypatch.setattr(accounts, "problems", lambda settings: [])
    monkeypatch.setattr(user_limits, "missing_controllers", list)
    monkeypatch.setattr(machine, "_used", lambda address, port: "")
    monkeypatch.setattr(machine, "_can_hide_users", lambda: True)
    monkeypatch.setattr(machine.shutil, "disk_usage", lambda folder: SimpleNamespace(free=3e9))
    return monkeypatch


def test_nothing_is_missing_on_a_machine_that_has_everything(complete):
    assert [*machine.missing(settings()), *machine.weaknesses()] == []


def test_only_root_can_start_a_hub(complete):
    complete.setattr(os, "geteuid", lambda: 1000)
    assert machine.missing(settings()) == [
        "a hub starts servers of other users, and only root can do that: run it with sudo"
    ]


def test_missing_commands_are_named_with_the_package_that_has_them(complete):
    complete.setattr(machine.shutil, "which", lambda command: None)
    found = machine.missing(settings())
    assert found[:2] == [
        "there is no npm: install it with `apt install npm`",
        "there is no node: install it with `apt install nodejs`",
    ]
    assert found[-1] == "there is no bwrap: install it with `apt install bubblewrap`"


def test_a_python_that_is_for_root_only_does_not_count(complete):
    complete.setattr(machine, "find_python", lambda: "")
    assert machine.missing(settings()) == [
        "no Python 3.11 to 3.14 is in /usr/bin or /usr/local/bin, and users can't run one of root's: "
        "install it with `apt install python3 python3-venv python3-dev`"
    ]


def test_without_pam_there_are_no_passwords(complete):
    complete.setattr(machine, "PAM", Path("/nowhere/login"))
    assert machine.missing(settings()) == [
        "there is no /nowhere/login, with which passwords are checked: install it with `apt install login`"
    ]


def test_a_port_that_is_used_is_named(monkeypatch):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        for first in (port, port - 1):
            assert (
                f"port {port} of '127.0.0.1' can't be used (Address already in use): change server.port"
            ) in machine.used_ports(settings(port=first))


def test_the_last_ports_leave_no_room_for_the_others():
    assert (
        "port 65536 of '127.0.0.1' can't be used (there is no such port): change server.port"
    ) in machine.used_ports(settings(port=65_535))


def test_passwords_cross_no_network_unencrypted(complete):
    assert machine.missing(settings(address="")) == [
        "with the address '' passwords would cross the network unencrypted: write server.certificate and "
        "server.key, or keep 127.0.0.1 and put a proxy with https before it"
    ]


def test_a_certificate_that_cannot_be_read_is_named(complete):
    assert machine.missing(settings(certificate="/no/cert.pem", key="/no/key.pem")) == [
        "server.certificate can't be read: /no/cert.pem", "server.key can't be read: /no/key.pem",
    ]


def test_a_machine_that_limits_nothing_is_a_weakness_and_no_obstacle(complete):
    complete.setattr(user_limits, "missing_controllers", lambda: ["memory", "cpu"])
    assert machine.weaknesses() == [
        "this machine doesn't let users limit memory, cpu (control groups in /sys/fs/cgroup): one user can take all "
        "of it; on a server use a system with systemd"
    ]


def test_a_full_disk_is_named_with_what_the_installation_and_a_start_need(complete, tmp_path):
    there = settings(folder=str(tmp_path))
    complete.setattr(machine.shutil, "disk_usage", lambda folder: SimpleNamespace(free=1.5e9))
    assert machine.missing(there) == [
        f"the disk of {tmp_path} is full: 1500 MB are free, and the hub needs 2000 MB; make room, and run `make hub` "
        "again"
    ]
    (tmp_path / "installation" / ".venv").mkdir(parents=True)
    assert machine.missing(there) == []


def test_a_container_without_the_right_to_mount_is_a_weakness(complete):
    complete.setattr(machine, "_can_hide_users", lambda: False)
    assert machine.weaknesses() == [
        "root may not mount file systems here: users see the names of other users' processes, and of their files in "
        "/tmp; a container needs the capability SYS_ADMIN for that"
    ]


def user(name: str, home: Path, number: int = 4242, group: int = 0) -> pwd.struct_passwd:
    return pwd.struct_passwd((name, "x", number, group, "", str(home), "/bin/sh"))


def test_users_of_the_system_are_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(pwd, "getpwnam", lambda name: user(name, tmp_path / "no", number=2))
    assert accounts.problems(settings()) == [
        "alice is a user of the system (number 2): choose another name",
        "ines is a user of the system (number 2): choose another name",
    ]


def test_a_home_that_others_can_enter_and_a_shared_group_are_named(monkeypatch, tmp_path):
    tmp_path.chmod(0o755)
    monkeypatch.setattr(pwd, "getpwnam", lambda name: user(name, tmp_path))
    assert accounts.problems(settings()) == [
        "the group of alice is root, and others may be in it: give alice a group, with "
        "`groupadd alice && usermod -g alice alice`",
        f"others can enter the home of alice: run `chmod 700 {tmp_path}`",
        f"others can enter the home of ines: run `chmod 700 {tmp_path}`",
    ]


def test_missing_users_are_no_problem(monkeypatch):
    monkeypatch.setattr(pwd, "getpwnam", {}.__getitem__)
    assert accounts.problems(settings()) == []


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "class").mkdir()
    return tmp_path


def test_the_first_call_writes_the_settings_and_asks_for_names(course, capsys):
    assert cli.main(["--check"]) == 1
    assert capsys.readouterr().err == (
        "No hub: class/hub.toml names no users: enter teachers and students, and run `make hub` again.\n"
    )
    assert (course / "class" / "hub.toml").exists()


def test_the_check_prints_a_line_for_each_thing_and_fails(course, complete, capsys):
    (course / "class" / "hub.toml").write_text("[courses.ros2]\nteachers = ['ines']\n[server]\nport = 41000\n")
    assert cli.main(["--check"]) == 0
    assert capsys.readouterr().out == "Nothing is missing.\n"
    complete.setattr(os, "geteuid", lambda: 1000)
    complete.setattr(machine, "find_python", lambda: "")
    assert cli.main([]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line[:30] for line in lines] == ["A hub starts servers of other ", "No Python 3.11 to 3.14 is in /"]


def test_a_command_that_fails_is_named_with_what_it_printed(monkeypatch, tmp_path):
    with pytest.raises(accounts.CourseError) as raised:
        accounts._run("sh", "-c", "echo no room >&2; exit 1")
    assert str(raised.value) == "`sh -c echo no room >&2; exit 1` failed: no room"
