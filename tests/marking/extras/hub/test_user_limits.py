"""The files of control groups that limit a user, in both of Linux's forms."""
from pathlib import Path

from grader.marking.extras.hub import user_limits
from grader.marking.extras.hub.hub_settings import UserLimits

LIMITS = UserLimits(memory_gb=1.5, processes=200, cpus=0.5)


def separate(root: Path, *controllers: str) -> Path:
    for name in controllers:
        (root / name).mkdir(parents=True)
        (root / name / "cgroup.procs").touch()
    return root


def written(root: Path) -> dict[str, str]:
    return {path.relative_to(root).as_posix(): path.read_text() for path in root.rglob("*.*") if path.is_file()}


def test_the_second_form_has_one_group_with_all_limits(tmp_path):
    (tmp_path / "cgroup.controllers").write_text("cpuset cpu io memory pids")
    assert user_limits.missing_controllers(tmp_path) == []
    group = tmp_path / "ros2-hub" / "alice"
    assert user_limits.make_group("alice", LIMITS, tmp_path) == [group / "cgroup.procs"]
    assert written(group) == {
        "memory.max": "1500000000", "memory.swap.max": "0", "pids.max": "200", "cpu.max": "50000 100000",
    }


def test_the_second_form_without_a_controller_limits_nothing(tmp_path):
    (tmp_path / "cgroup.controllers").write_text("memory")
    assert user_limits.missing_controllers(tmp_path) == ["pids", "cpu"]
    assert user_limits.make_group("alice", LIMITS, tmp_path) == []


def test_the_second_form_in_a_container_that_may_not_divide_its_group_limits_nothing(tmp_path):
    (tmp_path / "cgroup.controllers").write_text("cpuset cpu io memory pids")
    (tmp_path / "cgroup.subtree_control").mkdir()  # a write ends with an OSError, as in such a container
    assert user_limits.missing_controllers(tmp_path) == ["memory", "pids", "cpu"]
    assert user_limits.make_group("alice", LIMITS, tmp_path) == []


def test_the_first_form_has_a_group_for_each_controller(tmp_path):
    root = separate(tmp_path, "memory", "pids", "cpu")
    groups = user_limits.make_group("alice", LIMITS, root)
    assert groups == [root / name / "ros2-hub" / "alice" / "cgroup.procs" for name in ("memory", "pids", "cpu")]
    names = {
        "memory/ros2-hub/alice/memory.limit_in_bytes": "1500000000", "pids/ros2-hub/alice/pids.max": "200",
        "cpu/ros2-hub/alice/cpu.cfs_period_us": "100000", "cpu/ros2-hub/alice/cpu.cfs_quota_us": "50000",
    }
    assert names.items() <= written(root).items()


def test_the_first_form_limits_what_it_can(tmp_path):
    root = separate(tmp_path, "memory")
    assert user_limits.missing_controllers(root) == ["pids", "cpu"]
    assert [path.parents[2].name for path in user_limits.make_group("alice", LIMITS, root)] == ["memory"]


def test_a_group_is_removed_when_it_is_empty(tmp_path):
    root = separate(tmp_path, "memory", "pids", "cpu")
    for name in user_limits.CONTROLLERS:
        (root / name / "ros2-hub" / "alice").mkdir(parents=True)
    user_limits.end_group("alice", root)
    assert not list(root.glob("*/ros2-hub/*/cgroup.procs"))
