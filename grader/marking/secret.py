"""The instructor's secret, from which marking derives different worlds and seeds for each student.

One line of text in the file `.secret` beside `nbgrader_config.py`, readable by its owner alone and never
under version control. This makes one:

    umask 077; python3 -c 'import secrets; print(secrets.token_hex(32))' > .secret

Without the file marking uses the public seeds, those of the students' own checks.
"""
import os
import stat
from collections.abc import Sequence
from pathlib import Path

from grader.grading import VARIABLE
from grader.seeds import secret_of_student

ACCEPTED = "RUN_WITHOUT_SANDBOX"  # an environment variable, with the value "yes"
WITHOUT_SANDBOX = (
    "Not marked: `nbgrader autograde` runs students' code without a sandbox, where it can read and change "
    "all your files. Use `python -m grader mark`, or set the environment variable RUN_WITHOUT_SANDBOX=yes."
)
VARIED = (
    "Not marked: {0} has variants, and `nbgrader autograde` would run the same tests for every student. Use "
    "`python -m grader mark {0}`."
)


def read(folder: Path) -> str:
    """The secret of the course in `folder`, or "" without the file. Raises SystemExit: see `read_file`."""
    file = folder.absolute() / ".secret"
    return read_file(file) if file.exists() else ""


def read_file(file: Path) -> str:
    """The secret in a file.

    Raises SystemExit when the file is empty, cannot be read or others may read it: otherwise marking would
    continue with the public seeds.
    """
    if file.exists() and stat.S_IMODE(file.stat().st_mode) & 0o077:
        raise SystemExit(f"Others may read {file}: run `chmod 600 {file.name}`, then mark again.")
    try:
        text = file.read_text().strip()
    except OSError as error:
        raise SystemExit(f"{file} cannot be read ({error.strerror}): mark as the user who owns it.") from None
    if not text:
        raise SystemExit(f"{file} is empty: write a long random line into it, or delete it.")
    return text


def require_acceptance() -> None:
    """Raise SystemExit unless the instructor accepts that nbgrader runs students' code without a sandbox."""
    if os.environ.get(ACCEPTED) != "yes":
        raise SystemExit(WITHOUT_SANDBOX)


def require_no_variants(assignment: str) -> None:
    """Raise SystemExit for an assignment whose tests are different for each student."""
    import nbformat

    from grader.marking.judge.personal_release import has_variants

    found = Path("exercises", assignment).glob("*.ipynb") if assignment else ()
    if has_variants(nbformat.read(path, 4) for path in found):
        raise SystemExit(VARIED.format(assignment))


def set_course_secret(notebooks: Sequence[str] = (), **_: object) -> None:
    """Pass the secret of one student to the kernel that marks, as the variable COURSE_SECRET.

    notebooks: paths of this student's, in class/submitted/STUDENT/ASSIGNMENT/.

    nbgrader calls this before it marks a submission (`Autograde.pre_convert_hook`), never for Validate.
    Raises SystemExit as `read` and `require_acceptance` do: nbgrader only logs other exceptions, and would
    continue.
    """
    require_acceptance()
    require_no_variants(Path(notebooks[0]).parent.name if notebooks else "")
    text = read(Path())
    if text:
        student = Path(notebooks[0]).parents[1].name if notebooks else ""
        os.environ[VARIABLE] = secret_of_student(text, student)


def remove_course_secret(**_: object) -> None:
    """Remove the variable when a submission is marked (`Autograde.post_convert_hook`)."""
    os.environ.pop(VARIABLE, None)
