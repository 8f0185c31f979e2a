"""What was run once is not run again: recordings and notebooks are kept, verdicts are always given afresh.

A thing is kept under a digest of all that it depends on. For a recording that is not what reads it: checks,
diagnosis, pages. A new clone has nothing, and makes it all.
"""

from __future__ import annotations

import functools
import hashlib
import os
import pickle
import shutil
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import sim
from grader.workspace import installation
from sim import Recording

ROOT = Path(__file__).parents[2]
KEPT = ROOT / ".pytest_cache" / "d"  # pytest's own place for such things; `make clean` removes it
LEAST = 0.02  # s of computing: a run that takes less is not worth a file; to read one takes a fiftieth of it
WHOLE = ("sim", "ros_packages", "requirements.lock")
SHOW = "view", "standalone", "README.md", "TUTORIALS.md", "__pycache__"  # of sim: they only show recordings
RUN = sorted({path.name for path in (ROOT / "sim").iterdir()} - {*SHOW})
ADVERSARIES = "adversaries", "more_adversaries", "test_adversaries", "at_times", "cards", "changed_recordings"
ENGINE = *WHOLE[1:], *(f"sim/{name}" for name in RUN)
COURSE = (*ENGINE, "grader/programs.py", "grader/exercise.py", "grader/scenario.py", "grader/seeds.py")
COURSE += "grader/orders.py", "grader/workspace"
COURSE += "grader/companions", "grader/worlds", "grader/geometry"


@functools.cache
def digest_of(*sources: str) -> str:
    """Digest of files and folders of this repository, and of what else decides what a program does."""
    digest = hashlib.sha256(f"{sys.version} {os.environ.get('PYTHONHASHSEED')}".encode())
    for source in sources:
        for path in sorted([ROOT / source, *(ROOT / source).rglob("*")]):
            if path.is_file() and "__pycache__" not in path.parts:
                digest.update(f"\n{path.relative_to(ROOT)} {path.stat().st_size}\n".encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


class Evidence:
    """A folder of what depends on the same sources, for all workers; what came of older sources goes.

    The runs of the program that was asked for last are at hand without it.
    """

    _latest: ClassVar[tuple[str, dict[str, Recording]]] = "", {}

    def __init__(self, name: str, *sources: str) -> None:
        self._folder = KEPT / f"{name}-{digest_of(*sources)}"
        for old in set(KEPT.glob(f"{name}-*")) - {self._folder}:
            shutil.rmtree(old, ignore_errors=True)  # another worker may be at it, too
        self._folder.mkdir(parents=True, exist_ok=True)

    @classmethod
    def of_nodes(cls, topic: str) -> Evidence:
        """The recordings of the students' nodes of an assignment."""
        return cls(f"nodes-{topic}", *COURSE, *_own(topic))

    @classmethod
    def of_adversaries(cls, topic: str) -> Evidence:
        """The recordings of nodes that know the topics of an assignment's exercises and not the answers."""
        modules = (f"tests/exercises/{name}.py" for name in ADVERSARIES)
        return cls(f"adversaries-{topic}", *COURSE, *_own(topic), *modules)

    @classmethod
    def of_notebooks(cls, folder: str, assignment: str) -> Evidence:
        """A notebook that was run, of the folder solutions, exercises or course."""
        return cls(f"{folder}-{assignment}", *WHOLE, "grader", f"{folder}/{assignment}")

    def get(self, name: str, make: Callable[[], Any]) -> Any:
        """What is kept under a name; else it is made, and kept if that took some computing."""
        path = self._folder / name
        if path.exists():
            return pickle.loads(zlib.decompress(path.read_bytes()))
        begin = _computed()
        made = make()
        if _computed() - begin > LEAST:
            beside = path.with_suffix(f".{os.getpid()}")
            beside.write_bytes(zlib.compress(pickle.dumps(made), 1))
            beside.replace(path)  # at once: another worker reads the whole of it
        return made

    def keeping(self, program: str, run: Callable[..., Recording] = sim.run) -> Callable[..., Recording]:
        """`sim.run` for a student's program of this name, which makes what is not kept."""
        if Evidence._latest[0] != f"{self._folder}/{program}":
            Evidence._latest = f"{self._folder}/{program}", {}
        at_hand = Evidence._latest[1]

        def kept_or_made(*programs: Any, **scenario: Any) -> Recording:
            plain = repr([scenario[name] for name in ("world", "seconds", "seed", "order")])
            plain += "".join(map(_typos, programs)) + _installed()
            name = f"{program}-{hashlib.sha256(plain.encode()).hexdigest()[:16]}"
            if name not in at_hand:
                at_hand[name] = self.get(name, lambda: run(*programs, **scenario))
            return at_hand[name]

        return kept_or_made


def _own(topic: str) -> tuple[str, ...]:
    own = f"grader/exercises/{topic}", f"tests/exercises/{topic}", "tests/students/workspaces.py"
    own += "tests/students/teams.py", "tests/bench/delivery"  # robots of several programs
    return *own, "tests/exercises/navigator/parts.py"  # of two assignments


def _typos(program: Any) -> str:
    """What tells a program without its typos from the program itself."""
    is_set = isinstance(program, sim.Process)
    return repr([program.remappings, program.lenient]) if is_set else ""


def _installed() -> str:
    """Digest of the package that is installed for a run: a corrected one has other files."""
    digest = hashlib.sha256()
    for prefix in installation._prefixes:
        for path in sorted(prefix.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                digest.update(f"\n{path.relative_to(prefix)}\n".encode() + path.read_bytes())
    return digest.hexdigest() if installation._prefixes else ""


def _computed() -> float:
    """Seconds that this process and those it has waited for have computed."""
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system
