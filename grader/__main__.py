"""The commands of the course: `python -m grader mark`, `league`, `certificate` and `confirm`; see --help.

Students have `league` alone.
"""
import importlib
import importlib.util
import sys

COMMANDS = {  # module and function, and how it is used
    "mark": ("grader.marking.command.cli", "main", "ASSIGNMENT"),
    "league": ("grader.marking.league.cli", "main", "[NOTEBOOK ...]"),
    "certificate": ("grader.marking.certificate.cli", "certificate", "--issuer WORDS"),
    "confirm": ("grader.marking.certificate.cli", "confirm", "PAGE"),
}


def usage() -> str:
    """How the commands are used that are there."""
    lines = [f"python -m grader {name} {COMMANDS[name][2]} [--help]" for name in COMMANDS if _is_there(name)]
    return "usage: " + "\n       ".join(lines)


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if command in COMMANDS and _is_there(command):
        module, function, _ = COMMANDS[command]
        return int(getattr(importlib.import_module(module), function)(rest))
    asked = command in ("-h", "--help")
    print(usage(), file=sys.stdout if asked else sys.stderr)
    return 0 if asked else 2


def _is_there(command: str) -> bool:
    package = COMMANDS[command][0].rpartition(".")[0]
    return importlib.util.find_spec(package) is not None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
