"""What can go wrong with the sandbox itself. What an inmate does wrong is in its Ending."""


class SandboxMissing(RuntimeError):
    """This system has no sandbox; the text says what is missing and what to do."""


class SandboxFailed(RuntimeError):
    """The sandbox does not work; the text says what it said last."""
