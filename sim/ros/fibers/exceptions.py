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

    It ends the run and leaves `sim.run`. A BaseException, so that nobody takes it for a node's own error.

    reason: one sentence that says so. lives: whether the process is still there and listens: then it can be
    led on, to something else. mistake: what this side ran into, where the mistake is ours.
    """

    def __init__(self, reason: str, lives: bool = False, mistake: Exception | None = None) -> None:
        super().__init__(reason)
        self.reason, self.lives, self.mistake = reason, lives, mistake
