"""The instructor's commands: `python -m grader mark ASSIGNMENT`, see its --help."""
import sys

# jsonschema, below nbgrader, would load this to check web addresses: more than a second, for nothing.
sys.modules.setdefault("rfc3987_syntax", None)  # type: ignore[arg-type]
USAGE = "usage: python -m grader mark ASSIGNMENT [--help]"


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if command != "mark":
        print(USAGE, file=sys.stdout if command in ("-h", "--help") else sys.stderr)
        return 0 if command in ("-h", "--help") else 2
    from grader.marking.command.cli import main as mark

    return mark(rest)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
