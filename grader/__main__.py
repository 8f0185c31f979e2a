"""The commands of the course: `python -m grader mark`, `league` and so on. Students have `league` only."""

import sys

from grader.plugins import COMMANDS, plugins


def usage() -> str:
    """The usage of the available commands."""
    return f"usage: python -m grader COMMAND ...\nCommands, each with --help: {', '.join(plugins(COMMANDS))}"


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if entry := plugins(COMMANDS).get(command):
        return int(entry.load()(rest))
    help_wanted = command in ("-h", "--help")
    print(usage(), file=sys.stdout if help_wanted else sys.stderr)
    return 0 if help_wanted else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
