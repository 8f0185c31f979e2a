"""The instructor's commands: `python -m grader mark`, `certificate` and `confirm`, see their --help."""
import sys

# jsonschema, below nbgrader, would load this to check web addresses: more than a second, for nothing.
sys.modules.setdefault("rfc3987_syntax", None)  # type: ignore[arg-type]
USAGE = """usage: python -m grader mark ASSIGNMENT [--help]
       python -m grader certificate --issuer WORDS [--help]
       python -m grader confirm PAGE [--help]"""


def main(arguments: list[str]) -> int:
    """Run a command; returns the exit status."""
    command, *rest = arguments or [""]
    if command == "mark":
        from grader.marking.command.cli import main as mark

        return mark(rest)
    if command in ("certificate", "confirm"):
        from grader.marking.certificate import cli

        return cli.certificate(rest) if command == "certificate" else cli.confirm(rest)
    asked = command in ("-h", "--help")
    print(USAGE, file=sys.stdout if asked else sys.stderr)
    return 0 if asked else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
