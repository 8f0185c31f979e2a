"""The commands of the course: `python -m grader mark`, `league` and so on. Students have `league` only."""

import sys

from grader.plugins import COMMANDS, plugin, plugin_names

NONE = "none, since this course was changed after it was set up: run `make setup`"
NOT_LOADED = "{} can't be loaded: {}. Install what it needs; for a command of the course, `make tools` does."


def usage() -> str:
    """The usage of the available commands."""
    names = ", ".join(plugin_names(COMMANDS)) or NONE
    return f"usage: python -m grader COMMAND ...\nCommands, each with --help: {names}"


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if entry := plugin(COMMANDS, command):
        try:
            run = entry.load()
        except ImportError as error:
            print(NOT_LOADED.format(command, error), file=sys.stderr)
            return 1
        return int(run(rest))
    help_wanted = command in ("-h", "--help")
    print(usage(), file=sys.stdout if help_wanted else sys.stderr)
    return 0 if help_wanted else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
