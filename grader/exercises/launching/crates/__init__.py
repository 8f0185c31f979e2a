"""A message, a service and an action of one's own, in a package that makes types of them."""

from collections.abc import Mapping

from grader.checks import Missed, tenths
from grader.checks.interface_definitions import PARTS, InterfacePart, read_definition
from grader.checks.packages import package_of
from grader.exercise import Exercise
from grader.exercises.launching.crates.cmake_lists import CMakeCommand, read_commands
from grader.workspace.interfaces import type_hash
from grader.workspace.package import PackageRun
from grader.workspace.package_xml import CMAKE
from grader.workspace.sources import Sources

NAME = "crate_interfaces"
CRATE, FIND, LIFT = FILES = "msg/Crate.msg", "srv/FindCrates.srv", "action/Lift.action"
STATES = ("uint8 EMPTY=0", "uint8 FULL=1")
USED = "geometry_msgs"
GENERATOR = "rosidl_generate_interfaces"
NEEDS = {  # what package.xml names, and in which tags: one of these, or both of a pair
    "ament_cmake": ("buildtool_depend",),
    "rosidl_default_generators": ("buildtool_depend", "build_depend", "depend"),
    "rosidl_default_runtime": ("exec_depend", "depend"),
    USED: ("depend", "build_depend exec_depend"),
    "rosidl_interface_packages": ("member_of_group",),
}

crates = Exercise("crates", "A message, a service and an action of your own", package=NAME, build_type=CMAKE,
                  seconds=0)

Read = Mapping[str, Mapping[str, InterfacePart]]


@crates.check(2)
def can_be_read(run: PackageRun) -> Read:
    """The three definitions can be read: a message, a service and an action."""
    sources = package_of(run).sources
    there = [path.removeprefix(f"{NAME}/") for path in sources if path.rpartition(".")[2] in PARTS]
    read, missed = {}, None
    for path in FILES:
        try:
            if path not in there:
                hint = ("The folder decides the kind: msg, srv or action. File names are written in "
                        "CapitalLetters, without _.")
                raise Missed(f"ws/src/{NAME}/{path}", f"{', '.join(there) or 'no definition'} there", hint)
            read[path] = read_definition(path, sources[f"{NAME}/{path}"], NAME)
        except Missed as first:
            missed = missed or first
    if missed:
        missed.credit, missed.measured = tenths(len(read) / len(FILES)), read
        raise missed
    return read


@crates.check(3, after=can_be_read)
def has_a_message(run: PackageRun, read: Read) -> None:
    """Crate has a label, a mass, a state and a place."""
    fields = ("string label", "float64 mass", "uint8 state", "geometry_msgs/Point place")
    _has(read, CRATE, message=fields)


@crates.check(2, after=can_be_read)
def has_states(run: PackageRun, read: Read) -> None:
    """Crate has constants for the two states."""
    found = _definition(read, CRATE)["message"].constants
    if sorted(found) != sorted(STATES):
        hint = "Write a constant as type, name, = and value."
        raise Missed(f"{' and '.join(STATES)}", ", ".join(found) or "no constant", hint)


@crates.check(2, after=can_be_read)
def has_a_service(run: PackageRun, read: Read) -> None:
    """FindCrates has the heaviest mass in its request, and any number of crates in its response."""
    _has(read, FIND, request=("float64 heaviest",), response=("Crate[] crates",))


@crates.check(3, after=can_be_read)
def has_an_action(run: PackageRun, read: Read) -> None:
    """The goal of Lift is a label and a height; its result says if it was lifted, its feedback the height."""
    goal, now = ("string label", "float64 height"), ("float64 height",)
    _has(read, LIFT, goal=goal, result=("bool lifted",), feedback=now)


@crates.check(2)
def describes_itself(run: PackageRun) -> None:
    """package.xml names the code generator for the definitions, and the package whose message they use."""
    tags = package_of(run).package_xml.tags
    for name, ways in NEEDS.items():
        if not any(all(name in tags.get(tag, ()) for tag in way.split()) for way in ways):
            there = ", ".join(f"<{tag}>" for tag, texts in tags.items() if name in texts)
            hint = f"Add <{ways[0]}>{name}</{ways[0]}>."
            raise Missed(f"{name} as <{ways[0]}>", there or "no such line", hint)


@crates.check(4)
def makes_types(run: PackageRun) -> None:
    """CMakeLists.txt finds the packages it needs, and lists each definition."""
    sources = package_of(run).sources
    commands = read_commands(sources[f"{NAME}/CMakeLists.txt"])
    names = [command.name for command in commands]
    if "cmake_minimum_required" not in names[:1]:
        hint = "Make it the first command: without it CMake stops."
        raise _line("cmake_minimum_required(VERSION 3.10)", "none at the beginning", hint)
    if ("project", NAME) not in {(it.name, *it.words[:1]) for it in commands}:
        raise _line(f"project({NAME})", "none with this name", "Use the same name as in package.xml.")
    if GENERATOR not in names:
        raise _line(f"{GENERATOR}(...)", "none", "Add it: this command generates types from the definitions.")
    place = names.index(GENERATOR)
    found = [it.words[0] for it in commands[:place] if it.name == "find_package" and it.words]
    for name in ("rosidl_default_generators", USED):
        if name not in found:
            saw = f"{', '.join(found) or 'nothing'} before {GENERATOR}"
            raise _line(f"find_package({name} REQUIRED)", saw,
                        "CMake finds only what you name in find_package: add a line for each.")
    _hands_over(commands[place], sources)
    if "ament_package" not in names[place:]:
        hint = "Without it, other packages can't find what was installed."
        raise _line("ament_package() at the end", "none there", hint)


@crates.check(2, after=(can_be_read, makes_types))
def types_are_built(run: PackageRun) -> None:
    """The package is built, and programs can import its three types."""
    built = package_of(run).built
    if built.problem:
        hint = "A line above says why; or run colcon build in ws, and read its first error."
        raise Missed("an interface package that can be built", built.problem, hint, because=(can_be_read,))
    absent = [path for path in FILES if not type_hash(built.files, NAME, path.rpartition(".")[0])]
    if absent:
        hint = "Types are built only for the definitions that you list in the command: list all three."
        raise Missed("three types that can be imported", f"none for {', '.join(absent)}", hint)


def _hands_over(command: CMakeCommand, sources: Sources) -> None:
    """Miss a definition that is left out, one that isn't there, or the package whose message they use."""
    target, words = command.words[:1], command.words[1:]
    if not target or "/" in target[0]:
        hint = "The first argument is the package's name; the files come after it."
        raise Missed(f"${{PROJECT_NAME}} first in {GENERATOR}", target[0] if target else "nothing", hint)
    end = words.index("DEPENDENCIES") if "DEPENDENCIES" in words else len(words)
    named = words[:end]
    left_out = [path for path in FILES if path not in named]
    if left_out:
        credit = 0.5 if len(left_out) < len(FILES) else 0.0
        hint = "A file that isn't listed there isn't built. Spell the folder and the file exactly."
        expected = f"{', '.join(FILES)} in {GENERATOR}"
        raise Missed(expected, ", ".join(named) or "none", hint, credit=credit)
    there = {*FILES, *(path.removeprefix(f"{NAME}/") for path in sources)}
    absent = next((path for path in named if "/" in path and path not in there), "")
    if absent:
        raise Missed(f"only files that exist in {GENERATOR}", absent, "Leave it out.", credit=0.5)
    if USED not in words[end:]:
        hint = "Crate uses a message from that package, so its types depend on that package's."
        saw = " ".join(words[end:]) or "no DEPENDENCIES"
        raise Missed(f"DEPENDENCIES {USED} in {GENERATOR}", saw, hint, credit=0.5)


def _line(expected: str, saw: str, hint: str) -> Missed:
    return Missed(f"{expected} in CMakeLists.txt", saw, hint)


def _definition(read: Read, path: str) -> Mapping[str, InterfacePart]:
    """The parts of a definition; one that can't be read has cost its part already."""
    if path not in read:
        raise Missed(f"a {path} that can be read", "none", because=(can_be_read,))
    return read[path]


def _has(read: Read, path: str, **wanted: tuple[str, ...]) -> None:
    """Miss other fields than these, in this order, in a part of a definition."""
    found = _definition(read, path)
    for name, fields in wanted.items():
        there = found[name].fields
        if there != fields:
            where = path if len(wanted) == 1 else f"the {name} of {path}"
            hint = _misplaced(found, name, wanted) or _differs(there, fields)
            raise Missed(f"{', '.join(fields)} in {where}", ", ".join(there) or "nothing", hint)


def _misplaced(found: Mapping[str, InterfacePart], name: str, wanted: Mapping[str, tuple[str, ...]]) -> str:
    """Return what to do about a line of this part that belongs to another one; "" where there is none."""
    for field in found[name].fields:
        places = [other for other, fields in wanted.items() if field in fields]
        if places and name not in places:
            whole = " and the ".join(places)
            return f"`{field}` belongs to the {whole}: check where the --- lines are."
    return ""


def _differs(there: tuple[str, ...], wanted: tuple[str, ...]) -> str:
    """Return what to do about the first field that differs."""
    names = {field.rpartition(" ")[2]: field for field in there}
    for field in wanted:
        name = field.rpartition(" ")[2]
        if name not in names:
            return f"`{field}` is missing. Compare the names with the task, letter by letter."
        if names[name] != field:
            return f"Write `{field}`: with a different type, programs can't communicate."
    for field in there:
        if field not in wanted:
            return f"`{field}` isn't in the task: leave it out."
    return "Put them in this order: fields are sent in the order of the definition."
