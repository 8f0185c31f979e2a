"""The version depends on what can change a mark, and on nothing else."""
import re

import pytest

from grader.marking import pool, version
from grader.marking.build_process import builder
from grader.marking.version import APART, code_version, meaning, versions
from sim.course_folders import COURSE
from sim.distro import RCLPY_DISTRIBUTION
from tests.tooling.test_layers import import_graph, module_name, modules

MODULE = b'''"""What it is."""
# a comment
class A:
    """A class."""

    @check(2)
    def moves(self):
        """The robot moves."""
        return 1
'''


@pytest.fixture
def code(tmp_path, monkeypatch):
    """A small course, whose version is computed anew at each call."""
    monkeypatch.setattr(version, "CODE", (tmp_path / "grader", tmp_path / "sim"))
    monkeypatch.setattr(version, "KNOWN", tmp_path / "known" / "versions.json")
    names = "grader/check.py", "grader/marking/command/cli.py", "sim/view/page.js", "sim/world/build/rays.so"
    for name in names:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(MODULE)
    (tmp_path / "sim" / "world" / "room.toml").write_text("size = 1")
    (tmp_path / "sim" / "README.md").write_text("read")

    def change(name: str, old: bytes = b"return 1", new: bytes = b"return 2", also: str = "") -> bool:
        """Whether the version changes with a file."""
        before = code_version.__wrapped__(also)
        path = tmp_path / name
        assert old in path.read_bytes()
        path.write_bytes(path.read_bytes().replace(old, new))
        return code_version.__wrapped__(also) != before

    return change


@pytest.mark.parametrize(
    ("old", "new", "changes"),
    [
        (b"# a comment", b"# another comment\n\n", False),
        (b"What it is", b"What it isn't", False),
        (b"A class", b"One", False),
        (b"The robot moves", b"The robot drives", True),  # the sentence that a student reads
        (b"return 1", b"return 2", True),
        (b"return 1", b"return (1)  # one", False),
    ],
)
def test_comments_and_docstrings_don_t_count_but_those_of_checks_do(code, old, new, changes):
    assert code("grader/check.py", old, new) is changes


def test_files_that_change_no_mark_don_t_count(code):
    assert code("sim/world/room.toml", b"1", b"2")
    assert not code("sim/README.md", b"read", b"unread")
    assert not code("sim/view/page.js")
    assert not code("sim/world/build/rays.so")
    assert not code("grader/marking/command/cli.py")
    assert code("grader/marking/command/cli.py", b"return 2", b"return 3", "grader/marking/command")


def test_a_version_that_is_known_is_not_computed_again(code, monkeypatch):
    first = code_version.__wrapped__()
    monkeypatch.setattr(version, "meaning", None)
    assert code_version.__wrapped__() == first
    version.KNOWN.write_text("damaged")
    with pytest.raises(TypeError):
        code_version.__wrapped__()


def test_a_folder_that_can_t_be_written_costs_only_time(code, tmp_path):
    (tmp_path / "known").write_text("a file")
    assert not code("sim/README.md", b"read", b"unread")


def test_no_process_that_judges_or_is_judged_imports_what_doesn_t_count():
    files = {module_name(file): text for file, text in modules()}
    graph = import_graph(files, annotations=False)
    starts = (*pool.PRELOAD, *builder.PRELOAD, pool.JUDGE_ENTRY, builder.ENTRY, "grader.marking.pool")
    marking = ("judge", "student_process", "build_process", "sandbox", "submission")
    parts = (*(f"grader.marking.{name}." for name in marking), "grader.exercises.", "grader.companions.")
    found: set[str] = set()
    left = [start.partition(":")[0] for start in starts]
    left += [name for name in files if name.startswith(parts)]
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            left += [*graph.get(name, ()), *filter(None, [name.rpartition(".")[0]])]
    apart = tuple(each.removesuffix(".py").replace("/", ".") for each in APART)
    assert {"grader.marking.judge.mark_submission", "sim.ros.run", "grader.score"} <= found
    assert [name for name in found if name in apart or name.startswith(tuple(f"{it}." for it in apart))] == []
    there = [each for each in APART if (COURSE / each).exists()]
    assert APART - {*there} <= {"grader/marking/extras"}  # which may be missing: see .ci/parts


def test_the_version_is_that_of_the_code():
    first = code_version()
    code_version.cache_clear()
    assert code_version() == first
    assert len(first) == 64
    assert meaning(MODULE) == meaning(MODULE.replace(b"# a comment", b""))


def test_versions_name_all_that_a_grade_depends_on():
    found = versions()
    assert list(found) == ["course", "Python", RCLPY_DISTRIBUTION, "numpy", "pymunk", "ipython", "matplotlib"]
    assert found["course"] == code_version()[:12]
    assert re.fullmatch(r"3\.1[1234]", found["Python"])
