"""The commands of the course: `python -m grader mark`, `league` and so on; see --help.

Students have `league` only.
"""
import importlib
import importlib.util
import sys

COMMANDS = {  # module, function and arguments
    "mark": ("grader.marking.command.cli", "main", "ASSIGNMENT | --check"),
    "mark-one": ("grader.marking.extras.one_submission.cli", "main", "SUBMISSION --assignment NAME"),
    "due": ("grader.marking.command.due_cli", "main", "[ASSIGNMENT WHEN]"),
    "hub": ("grader.marking.extras.hub.cli", "main", "[--check]"),
    "league": ("grader.marking.extras.league.cli", "main", "[NOTEBOOK ...]"),
    "collect": ("grader.marking.extras.learning_platform.cli", "collect", "ARCHIVE.zip"),
    "grades": ("grader.marking.extras.learning_platform.cli", "grades", "ASSIGNMENT"),
    "platform": ("grader.marking.extras.platforms.cli", "main", "gradescope|... ASSIGNMENT"),
    "likeness": ("grader.marking.extras.likeness.cli", "main", "ASSIGNMENT"),
    "variants": ("grader.marking.extras.own_notebooks.cli", "main", "ASSIGNMENT"),
    "receipts": ("grader.marking.extras.receipts.cli", "receipts", "--issuer TEXT"),
    "verify": ("grader.marking.extras.receipts.cli", "verify", "RECEIPT"),
}


def usage() -> str:
    """The usage of the available commands."""
    installed = filter(_is_installed, COMMANDS)
    lines = [f"python -m grader {name} {COMMANDS[name][2]} [--help]" for name in installed]
    return "usage: " + "\n       ".join(lines)


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if command in COMMANDS and _is_installed(command):
        module, function, _ = COMMANDS[command]
        return int(getattr(importlib.import_module(module), function)(rest))
    help_wanted = command in ("-h", "--help")
    print(usage(), file=sys.stdout if help_wanted else sys.stderr)
    return 0 if help_wanted else 2


def _is_installed(command: str) -> bool:
    package = COMMANDS[command][0].rpartition(".")[0]
    try:
        return importlib.util.find_spec(package) is not None
    except ModuleNotFoundError:  # the package in which it would be
        return False


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
