"""The ROS domains on this machine, from its open sockets."""

import pytest

from sim.ros2 import domains

HEAD = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
LINE = "  12: 00000000:{:04X} 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 99 2\n"


@pytest.fixture
def sockets(tmp_path, monkeypatch):
    file = tmp_path / "udp"
    monkeypatch.setattr(domains, "_SOCKETS", file)
    return lambda *ports: file.write_text(HEAD + "".join(LINE.format(port) for port in ports))


def test_each_participant_has_two_ports_of_its_domain(sockets):
    sockets(7410, 7411, 7400 + 250 * 42 + 12, 7400 + 250 * 42 + 13, 53, 7400, 40000)
    assert domains.active_domains() == {0, 42}
    assert domains.participant_ports(42) == {17912, 17913}


def test_ports_that_linux_assigns_to_anything_say_nothing_of_a_domain(sockets):
    sockets(7400 + 250 * 103 + 12, 7400 + 250 * 220 + 12, 60_999)
    assert domains.active_domains() == {220}
    assert (domains.participant_ports(103), domains.participant_ports(220)) == ({33162}, {62412})


@pytest.mark.parametrize("text", ["0", "101", "102", "232", ""])
def test_all_domains_of_ros_are_accepted(text, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    assert domains.selected_domain() == int(text or 0)


def test_the_hint_names_the_domains_that_have_nodes_and_the_course_s_first(sockets):
    none = "There are no nodes on ROS domain 7 of this machine"
    sockets(17910, 17911, 7410, 7411, 7400 + 250 * 50 + 12)
    assert domains.no_nodes_hint(7) == (
        f"{none}, but on 42 (the domain of `python -m sim`), 50 and 0 (where runs in notebooks are, too,"
        " which no other process reaches). To use the first: export ROS_DOMAIN_ID=42"
    )
    sockets(7410, 7411, 7400 + 250 * 50 + 12)
    assert domains.no_nodes_hint(7) == (
        f"{none}, but on 50 and 0 (where runs in notebooks are, too, which no other process reaches)."
        " To use the first: export ROS_DOMAIN_ID=50"
    )
    sockets(7410, 7411)
    assert domains.no_nodes_hint(7) == (
        f"{none}, but on 0 (where runs in notebooks are, too, which no other process reaches)."
        " To use it: export ROS_DOMAIN_ID=0"
    )
    sockets()
    assert domains.no_nodes_hint(7) == f"{none}: start a node in another terminal, with ROS_DOMAIN_ID=7"


def test_unreadable_sockets_count_as_none(tmp_path, monkeypatch):
    monkeypatch.setattr(domains, "_SOCKETS", tmp_path / "none")
    assert domains.active_domains() == set()
