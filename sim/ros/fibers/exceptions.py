"""What is thrown into student code, or through it, to end a run. All are BaseExceptions: `except Exception`
lets them pass.
"""


class RunOver(BaseException):
    """Thrown into fibers that outlive their run."""


class Livelock(BaseException):
    """Callbacks keep calling each other and time never moves."""


class Hang(BaseException):
    """Student code did not give control back."""


class RemoteLost(BaseException):
    """Another process, in which nodes of the run live, is gone, silent, or sends what can't be.

    It ends the run and leaves `sim.run`. A BaseException, so that it isn't handled as a node's own error.

    reason: one sentence. lives: whether the process still runs and receives: then it can be used again.
    mistake: the exception in this process, if the mistake is the course's.
    """

    def __init__(self, reason: str, lives: bool = False, mistake: Exception | None = None) -> None:
        super().__init__(reason)
        self.reason, self.lives, self.mistake = reason, lives, mistake
