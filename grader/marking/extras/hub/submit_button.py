"""A student's list of assignments says why a submission failed in one sentence, not with a traceback."""
import errno
from typing import Any

from nbgrader.server_extensions.assignment_list.handlers import AssignmentList

NOT_RELEASED = "{} is not released yet: submit it when your teacher has released it. Your work is kept."
NO_SPACE = (
    "{} was not submitted: the disk is full. Tell your teacher; if it is your own quota, delete what you "
    "don't need. Then submit again. What you submitted before still counts."
)
FULL = f"[Errno {errno.ENOSPC}]", f"[Errno {errno.EDQUOT}]"
_submit = AssignmentList.submit_assignment


def submit(assignments: AssignmentList, course: str, assignment: str) -> dict[str, Any]:
    """Submit as nbgrader does; of an error keep its last line, which says what is wrong."""
    answer: dict[str, Any] = _submit(assignments, course, assignment)
    if not answer["success"]:
        if any(number in answer["value"] for number in FULL):
            return answer | {"value": NO_SPACE.format(assignment)}
        reason = answer["value"].strip().splitlines()[-1].partition(": ")[2]
        missing = reason.startswith("Assignment not found: ")
        answer["value"] = NOT_RELEASED.format(assignment) if missing else reason
    return answer


def _load_jupyter_server_extension(server: Any) -> None:
    AssignmentList.submit_assignment = submit


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "grader.marking.extras.hub.submit_button"}]
