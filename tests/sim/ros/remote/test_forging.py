"""Nodes in the other process can't change the leader's evidence; a lost process is reported."""

import pytest

from sim import run
from sim.ros.remote import RemoteLost
from tests.patience import PATIENCE

FORGERS = "tests.sim.ros.remote.forgers"


def drive(follower, name: str, **settings):
    with follower.serving(FORGERS, name) as remote:
        return run(remote, world="room", seconds=2, quiet=True, **settings)


def hellos(recording) -> list[tuple[float, str]]:
    return [(received.stamp, received.message.data) for received in recording.messages("/chat")]


@pytest.mark.parametrize("name", ["Honest", "Teleporter", "Forger"])
def test_messages_and_poses_cannot_be_forged(follower, name):
    recording = drive(follower, name)
    assert hellos(recording) == [(round(0.1 * tick, 1), "hello") for tick in range(1, 21)]
    assert {pose[1:] for pose in recording.path} == {recording.path[0][1:]}
    assert recording.logs == []
    assert (recording.ended.reason, recording.ended.stamp) == ("time", 2.0)


@pytest.mark.parametrize("name", ["Hurried", "Lazy"])
def test_a_clock_that_was_tampered_with_is_noticed(lost, name):
    with pytest.raises(RemoteLost) as found:
        drive(lost, name)
    assert found.value.reason == (
        "The process with the nodes sent a callback's duration that is not a number from 0 to 1e-09."
    )


def test_the_seed_and_the_secret_are_not_revealed(follower, monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "a secret of this test")
    texts = [drive(follower, "Spy", seed=seed).logs[0].text for seed in (7, 7, 8)]
    assert texts[0] == texts[1] != texts[2]
    seed, _, secret = texts[0].split(" ")
    assert "7" not in seed.split(",")
    assert secret == "None"


def test_the_secret_changes_the_nodes_random_numbers(follower):
    drawn = []
    for secret in ("", "a secret", "a secret"):
        with follower.serving(FORGERS, "Spy", secret=secret) as remote:
            drawn.append(run(remote, seconds=1, quiet=True).logs[0].text.split(" ")[1])
    assert drawn[0] != drawn[1] == drawn[2]


@pytest.mark.parametrize(
    ("name", "patience", "reason"),
    [
        ("Killed", PATIENCE, "The process with the nodes has ended."),
        ("Stopped", 1.0, "The process with the nodes gave no answer for 1 s."),
        (
            "Garbage",
            PATIENCE,
            "The process with the nodes sent a message on /chat that is not of type std_msgs/msg/String.",
        ),
        (
            "Heavy",
            PATIENCE,
            "The nodes could not be run: WireBroken: a message of 80000195 bytes is too long: "
            "64000000 are allowed.",
        ),
        (
            "Scribbler",
            PATIENCE,
            "The process with the nodes ended unexpectedly at 0.5 s: something in it ended the run there, "
            "or wrote to its connections.",
        ),
    ],
)
def test_losing_the_process_during_a_run_is_reported(lost, name, patience, reason):
    with pytest.raises(RemoteLost) as found, lost.serving(FORGERS, name, patience=patience) as remote:
        run(remote, world="room", seconds=2, quiet=True)
    assert found.value.reason == reason


def test_a_program_that_exits_does_not_end_its_process(follower):
    recording = drive(follower, "Exits")
    assert (recording.ended.reason, recording.errors[0].type) == ("error", "SystemExit")
    assert len(hellos(recording)) == 5


def test_a_lost_process_does_not_affect_the_next_run(lost):
    with pytest.raises(RemoteLost), lost.serving(FORGERS, "Killed") as remote:
        run(remote, world="room", seconds=2, quiet=True)
    assert len(hellos(drive(lost, "Honest"))) == 20
