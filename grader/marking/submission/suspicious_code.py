"""Finds code in a submission that attacks the marking instead of solving the task.

It decides nothing: points come from what the judge observed. It reports the code, so that an instructor can
talk to the student. A well-hidden attack is not found here, and gains no points either.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator

PUBLIC_MODULES = {"sim", "sim.view", "grader"}
PUBLIC_NAMES = "check|course_map|grade|tell|Exercise|Missed|Scenario|Score"  # of the package grader
PUBLIC = re.compile(rf"grader\.exercises\.\w+|grader\.(exercises|{PUBLIC_NAMES})")
MAX_SOURCE = 20_000  # characters of a cell
MAX_SOURCES = 400_000  # of all of them
COURSE = ("rclpy", "sim", "grader", "builtins")


def _by_word(table: dict[str, str]) -> dict[str, str]:
    """Map each word to its reason, from the words of each reason."""
    return {word: reason for reason, words in table.items() for word in words.split()}


# Modules that no exercise needs, by what they are used for.
MODULES = _by_word(
    {
        "runs code when the process ends": "atexit",
        "reaches into Python's memory": "ctypes",
        "finds objects that it was not given": "gc",
        "starts processes": "multiprocessing pty subprocess",
        "opens connections": "socket",
        "changes how cells are run and shown": "IPython",
    }
)
SHOWING = ("IPython.display", "IPython.core.display")  # of IPython: many notebooks import these
# Attributes of any object.
ATTRIBUTES = _by_word(
    {
        "finds classes that it was not given": "__subclasses__",
        "reaches into another function's module": "__globals__",
        "replaces or reads a function's code": "__code__",
        "changes what Python itself does": "__builtins__",
        "reaches into its callers": "_getframe f_back f_locals",
        "follows the marking step by step": "settrace setprofile",
        "replaces modules": "modules meta_path",
        "imports by text": "import_module",
        "rewrites cells before they run": (
            "ast_transformers input_transformers_cleanup input_transformers_post"
        ),
        "changes what cells show": "display_formatter displayhook display_pub",
        "changes how cells are run": "run_cell run_cell_async",
        "ends the process": "_exit",
        "stops processes": "kill killpg SIGKILL SIGSTOP",
        "interrupts what runs": "SIGALRM setitimer",
        "starts processes": "fork system popen execv",
        "reaches into other processes": "ptrace",
        "touches the process's own open files": "close closerange dup2 write",
        "searches the disk": "walk",
    }
)
# Words that are common attributes of other objects.
PROCESS_WORDS = ("kill", "fork", "system", "popen", "close", "dup2", "write", "walk")
OWNERS = {"modules": "sys", **dict.fromkeys(PROCESS_WORDS, "os")}
CALLS = _by_word({"runs text as code": "exec eval", "imports by text": "__import__ import_module"})
METHODS = _by_word(
    {
        "decides what it is equal to": "__eq__",
        "decides what number it is": "__float__",
        "decides what is an instance of it": "__instancecheck__",
        "runs code when it is thrown away": "__del__",
        "decides how it is shown": "_repr_html_ _repr_mimebundle_ _ipython_display_",
    }
)
SUSPICIOUS_TEXTS = ("COURSE_SECRET", "gradebook", ".secret", "/proc/", "<script", "onerror=", "javascript:")
SHELL = ("system", "getoutput")  # what IPython makes of !command
SHOWN = 60  # characters of the code that are reported
# IPython's own lines. IPython's transformer would parse the whole cell again for each: that takes minutes.
COMMAND = re.compile(r"^([ \t]*+)(?:\w[\w, \t]*=[ \t]*+)?!.*", re.MULTILINE)
MAGIC = re.compile(r"^([ \t]*+)(?:(?:\w[\w, \t]*=[ \t]*+)?%.*|\?.*|.*\?$)", re.MULTILINE)


def find_suspicious_code(cells: Iterable[tuple[str, str]]) -> list[str]:
    """A sentence for each suspicious thing in these cells, pairs of a name and a source; each thing once."""
    course: dict[str, str] = {}
    found: dict[str, None] = {}
    looked = 0
    for name, source in cells:
        if len(source) > MAX_SOURCE:
            long = f"has more than {MAX_SOURCE} characters: it was not searched"
            found.setdefault(f"The cell `{name}` {long}.")
            continue
        looked += len(source)
        if looked > MAX_SOURCES:
            long = f"and those before it have more than {MAX_SOURCES} characters: the rest was not searched"
            found.setdefault(f"The cell `{name}` {long}.")
            break
        tree = _parse(source)
        nodes = list(ast.walk(tree))
        for node in nodes:
            course |= _names_from_course(node)
        whats = [what for node in nodes for what in _oddities(node, course)]
        for what in whats + [what for statement in tree.body for what in _shadowed(statement, course)]:
            found.setdefault(f"The cell `{name}` {what}.")
    return list(found)


def _parse(source: str) -> ast.Module:
    """The cell's code; an empty module for invalid code."""
    for text in (source, _without_magic(source)):
        try:
            return ast.parse(text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
    return ast.Module([], [])


def _without_magic(source: str) -> str:
    """The source with IPython's own lines as Python; a cell magic becomes a string."""
    if source.lstrip().startswith("%%"):
        return repr(source)
    return MAGIC.sub(r"\1pass", COMMAND.sub(r"\1get_ipython().system('')", source))


def _names_from_course(node: ast.AST) -> dict[str, str]:
    """Names that an import binds from the course's or ROS's modules, with the module."""
    names = {}
    if isinstance(node, ast.Import):
        names = {(a.asname or a.name.split(".")[0]): a.name for a in node.names}
    elif isinstance(node, ast.ImportFrom) and node.module:
        names = {(a.asname or a.name): node.module for a in node.names}
    return {name: module for name, module in names.items() if module.split(".")[0] in COURSE}


def _oddities(node: ast.AST, course: dict[str, str]) -> Iterator[str]:
    if isinstance(node, ast.Import):
        for name in node.names:
            yield from _imports(name.name)
    elif isinstance(node, ast.ImportFrom) and node.module:
        yield from _imports(node.module)
        if node.module == "grader":
            yield from (inside for name in node.names for inside in _imports(f"grader.{name.name}"))
    elif isinstance(node, ast.Attribute):
        yield from _attribute(node)
        if not isinstance(node.ctx, ast.Load):
            yield from _replacements(node, course)
    elif isinstance(node, ast.Call):
        yield from _calls(node, course)
    elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name in METHODS:
        yield f"defines `{node.name}`, which {METHODS[node.name]}"
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield from (f"mentions `{word}`" for word in SUSPICIOUS_TEXTS if word in node.value)


def _imports(module: str) -> Iterator[str]:
    top = module.split(".")[0]
    if top in MODULES and module not in SHOWING:
        yield f"imports `{module}`, which {MODULES[top]}"
    public = module in PUBLIC_MODULES or PUBLIC.fullmatch(module)
    if top in ("sim", "grader") and not public:
        yield f"imports `{module}`, which is inside the course's own machinery"


def _attribute(node: ast.Attribute) -> Iterator[str]:
    reason = ATTRIBUTES.get(node.attr)
    owner = node.value.id if isinstance(node.value, ast.Name) else ""
    if reason and OWNERS.get(node.attr, owner) == owner:
        yield f"uses `{_code_of(node)}`, which {reason}"
    if _is_shell(node.value) and node.attr == "events":
        yield "uses `get_ipython().events`, which runs code around every cell"


def _replacements(node: ast.expr, course: dict[str, str], what: str = "") -> Iterator[str]:
    """Report an assignment to an attribute of a module of the course or of ROS."""
    root = node
    while isinstance(root, ast.Attribute):
        root = root.value
    if isinstance(root, ast.Name) and root.id in course:
        yield f"replaces {what}`{_code_of(node)}`, which is part of {course[root.id].split('.')[0]}"


def _shadowed(statement: ast.stmt, course: dict[str, str]) -> Iterator[str]:
    """Report a top-level statement that rebinds a name of the course."""
    names = [getattr(statement, "name", "")]
    if isinstance(statement, ast.Assign):
        parts = [part for target in statement.targets for part in ast.walk(target)]
        names = [part.id for part in parts if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)]
    for name in names:
        package = course.get(name, "").split(".")[0]
        if package in ("sim", "grader"):
            yield f"takes the name `{name}`, which is part of {package}"


def _calls(node: ast.Call, course: dict[str, str]) -> Iterator[str]:
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    if name in CALLS:
        yield f"calls `{name}(...)`, which {CALLS[name]}"
    if name == "setattr" and node.args:
        yield from _replacements(node.args[0], course, "attributes of ")
    if isinstance(node.func, ast.Attribute) and node.func.attr in SHELL and _is_shell(node.func.value):
        yield "runs a command of the system's shell, which starts processes"


def _code_of(node: ast.expr) -> str:
    """The code of an attribute; only its end if it is nested too deeply."""
    try:
        return ast.unparse(node)[:SHOWN]
    except RecursionError:
        return f"....{getattr(node, 'attr', '')}"[:SHOWN]


def _is_shell(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "get_ipython"
