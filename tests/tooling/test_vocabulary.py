"""Checks that names use the standard terms, and that no class or module name stands for two things."""

import ast
import functools
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("sim", "grader", "ros_packages")
OWN = ("sim", "grader")  # in ros_packages the names of modules and classes are those of ROS's own packages

# Words that are not used in names, with the standard terms.
WORDS = {
    "told": "published, reported, formatted or serialized; a function: format_... or serialize",
    "said": "published, logged or printed",
    "heard": "received; a Message",
    "hears": "receives, or is subscribed",
    "mend": "fix, correct or repair",
    "mended": "fixed, corrected or repaired",
    "mending": "fixing, correcting or repairing",
    "wish": "request, target or goal",
    "wishes": "requests, targets or goals",
    "ours": "from_course, or course_...",
    "theirs": "from_student, or student_...",
    "asked": "requested, called or looked up; parsed options: options",
}

# Modules with the same name that stand for the same thing.
SAME_MEANING = {
    "__main__": "what `python -m` runs",
    "cli": "a command line",
    "actions": "ROS actions",
    "services": "ROS services",
    "topics": "ROS topics",
    "parameters": "ROS parameters",
    "qos": "ROS quality of service",
    "connections": "which endpoints of the ROS graph match",
    "graph": "the ROS graph",
    "packages": "ROS packages",
    "nodes": "ROS nodes",
    "page": "a page in HTML",
    "people": "the people in a world",
    "play": "a run in real time",
    "run": "a run of programs",
    "notebook": "a Jupyter notebook",
    **dict.fromkeys(
        ("arm", "battery", "cart_pole", "imu", "joint", "machine", "robot", "turtle"),
        "in sim/world the physics, in sim/ros/robots the ROS node",
    ),
}


@functools.cache
def words_of(name: str) -> list[str]:
    """The words of an identifier, in lower case: "send_goal", "GoalSender" and "HTTPServer" have two each."""
    return [word.lower() for word in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)]


@functools.cache
def names(source: str) -> list[tuple[int, str, bool]]:
    """The line and name of every class, function, argument, attribute and global variable.

    The third item: whether it is a class.
    """
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            found.append((node.lineno, node.name, isinstance(node, ast.ClassDef)))
        elif isinstance(node, ast.arg):
            found.append((node.lineno, node.arg, False))
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            found.append((node.lineno, node.attr, False))
        if isinstance(node, ast.Module | ast.ClassDef):
            stored = (name for statement in node.body for name in assigned(statement))
            found += [(name.lineno, name.id, False) for name in stored]
    return found


def assigned(statement: ast.stmt) -> Iterator[ast.Name]:
    """The names in the targets of an assignment."""
    if isinstance(statement, ast.Assign | ast.AnnAssign):
        targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
        yield from (node for target in targets for node in ast.walk(target) if isinstance(node, ast.Name))


def private_words(file: str, source: str) -> list[str]:
    """A sentence for each name of a module that has one of WORDS: where it is, and the standard terms."""
    own = Path(file).parent.name if file.endswith("__init__.py") else Path(file).stem
    return [
        f"{file}:{line}: {name}: instead of {word!r} write {WORDS[word]}"
        for line, name, _ in sorted({(1, own, False), *names(source)})
        for word in words_of(name)
        if word in WORDS
    ]


def repeated_classes(files: dict[str, str]) -> list[str]:
    """A sentence for each class name that is defined more than once; files are path to source."""
    places = defaultdict(list)
    for file, source in files.items():
        for line, name, is_class in names(source):
            if is_class:
                places[name].append(f"{file}:{line}")
    return [
        f"{' and '.join(found)}: several classes are called {name}; name each by what it is"
        for name, found in sorted(places.items())
        if len(found) > 1
    ]


def repeated_modules(paths: list[str]) -> list[str]:
    """A sentence for each module name that occurs more than once, unless SAME_MEANING has it.

    A package may have a main module of its own name. What serves one exercise is named within its folder.
    """
    places = defaultdict(list)
    for path in map(Path, paths):
        name = path.parent.name if path.name == "__init__.py" else path.stem
        is_main = path.name != "__init__.py" and path.parent.name == name
        if is_main or path.is_relative_to("grader/exercises"):
            continue
        places[name].append(path.as_posix())
    return [
        f"{' and '.join(found)}: several modules are called {name}; name each by what it holds"
        for name, found in sorted(places.items())
        if len(found) > 1 and name not in SAME_MEANING
    ]


def sources(packages: tuple[str, ...]) -> dict[str, str]:
    files = (file for package in packages for file in sorted((ROOT / package).rglob("*.py")))
    return {file.relative_to(ROOT).as_posix(): file.read_text(encoding="utf-8") for file in files}


@pytest.mark.parametrize("package", PACKAGES)
def test_names_have_none_of_the_words(package):
    found = [hit for file, source in sources((package,)).items() for hit in private_words(file, source)]
    assert found == [], "\n".join(found)


def test_no_class_name_is_used_twice():
    found = repeated_classes(sources(OWN))
    assert found == [], "\n".join(found)


def test_no_module_name_is_used_twice():
    found = repeated_modules(list(sources(OWN)))
    assert found == [], "\n".join(found)


@pytest.mark.parametrize(
    ("source", "sentences"),
    [
        ("def told(message): ...", ["a.py:1: told: instead of 'told' write published, reported"]),
        ("def f(a, *, said=1, **wishes): ...", ["a.py:1: said: instead of", "a.py:1: wishes: instead of"]),
        ("class A:\n    def f(self):\n        self.last_heard = 1", ["a.py:3: last_heard: instead of"]),
        ("class NotOurs:\n    is_ours: bool = False", ["a.py:1: NotOurs:", "a.py:2: is_ours:"]),
        ("MENDED = 1\nWISHES, B = 1, 2", ["a.py:1: MENDED: instead of", "a.py:2: WISHES: instead of"]),
        ("slip, slipped, towhish, untold_, hearsay = 1, 2, 3, 4, 5", []),
        ("def f():\n    heard = 1  # told\n    return heard", []),
        ("x.asked\nx.asked = x.y = 1", ["a.py:2: asked: instead of 'asked' write requested"]),
    ],
)
def test_a_word_is_found_with_its_line_and_the_standard_term(source, sentences):
    found = private_words("a.py", source)
    assert len(found) == len(sentences)
    assert all(hit.startswith(sentence) for hit, sentence in zip(found, sentences, strict=True))


@pytest.mark.parametrize("file", ["sim/mending.py", "sim/mending/__init__.py"])
def test_a_word_is_found_in_the_name_of_a_module(file):
    assert private_words(file, "") == [f"{file}:1: mending: instead of 'mending' write {WORDS['mending']}"]


def test_a_class_name_that_is_used_twice_is_found():
    files = {"sim/a.py": "class Link: ...\nclass A: ...", "grader/b.py": "\ndef f():\n    class Link: ..."}
    assert repeated_classes(files) == [
        "sim/a.py:1 and grader/b.py:3: several classes are called Link; name each by what it is"
    ]


def test_a_module_name_that_is_used_twice_is_found():
    allowed = ["sim/engine/__init__.py", "sim/engine/engine.py", "sim/cli.py", "grader/cli.py"]
    exercises = ["grader/exercises/nodes/limits.py", "grader/exercises/joints/limits.py", "sim/limits.py"]
    assert repeated_modules([*allowed, *exercises]) == []
    (hit,) = repeated_modules([*allowed, "grader/engine.py"])
    assert hit.startswith("sim/engine/__init__.py and grader/engine.py: several modules are called engine; ")
