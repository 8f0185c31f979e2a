"""All errors for which a class, or one submission, can't be marked.

    MarkingError
    ├── CourseError             the command can't begin or go on; the instructor reads what to do
    │   ├── GradebookError      the gradebook can't be read or written
    │   ├── UnknownTest         the release has a test cell that can't be marked here
    │   └── NoVariants          the variants of a release can't be drawn
    ├── CommandFailed           a command of nbgrader's own failed
    ├── SandboxMissing          this system has no sandbox
    ├── SandboxFailed           the sandbox doesn't work
    ├── DaskPoolError           no worker on another machine is left
    ├── Unusable                a submission can't be marked; the student reads what to do
    ├── StudentProcessGone      a student's process can't be used any further; its notebook ends there
    ├── NotMarked               one submission could not be marked; the instructor has to look
    ├── NotConfirmed            a receipt does not agree with its signature or what it names
    └── ResultError             data that is not a result
"""


class MarkingError(Exception):
    """The base class; the text is for the user."""


class CourseError(MarkingError):
    """The whole command can't work; the message says what to do."""


class GradebookError(CourseError):
    """The gradebook can't be read or written; the message says why and what to do. Nothing is lost."""


class UnknownTest(CourseError):
    """A test cell that can't be marked here; the text says which, what was expected and what to do."""


class NoVariants(CourseError):
    """Variants that can't be drawn; the text says why and what to do, without a full stop."""


class CommandFailed(MarkingError):
    """An nbgrader command that failed; the text says which, where, and what it printed last."""


class SandboxMissing(MarkingError):
    """This system has no sandbox; the text says what is missing and what to do."""


class SandboxFailed(MarkingError):
    """The sandbox does not work; the text has its last output."""


class DaskPoolError(MarkingError):
    """Nothing more can be marked on other machines. The text says why, without a full stop."""


class Unusable(MarkingError):
    """A submission that cannot be marked. The text says what was expected, what was found and what to do."""


class StudentProcessGone(MarkingError):
    """A student's process can't be used any further. The text says why, as a sentence."""


class NotMarked(MarkingError):
    """A submission could not be marked. The text says what happened."""


class NotConfirmed(MarkingError):
    """A receipt can't be confirmed. The text says what does not agree, without a full stop."""


class ResultError(MarkingError):
    """Data is not a valid result; the message says what is wrong with it."""
