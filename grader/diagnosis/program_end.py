"""What comes out of main() on Ctrl-C, such as when rclpy is already shut down."""

from sim.evidence import CallbackError, Recording, frames_of

AGAIN = "rcl_shutdown already called"
FIRST = "On Ctrl-C, rclpy shuts down first, and then main() gets the KeyboardInterrupt"


def ends_in_error(recording: Recording) -> str:
    """A main() that ends in an error after the Ctrl-C at the end of the run, or after its own."""
    return next((_sentence(error) for error in recording.end_errors), "")


def _sentence(error: CallbackError) -> str:
    if error.type == "KeyboardInterrupt":
        return (
            f"KeyboardInterrupt came out of {error.callback}(){_place(error)}, which prints a traceback in a "
            "terminal. Spin in a try block with `except KeyboardInterrupt:` below it; "
            "a `pass` there is enough."
        )
    if AGAIN in error.text:
        return (
            f"{FIRST}: there rclpy.shutdown() raises `{AGAIN}`{_place(error)}. "
            "Write rclpy.try_shutdown() instead."
        )
    if "context is invalid" in error.text or "context is not valid" in error.text:
        return (
            f"{FIRST}: there {error.callback} ends in {error.type}{error.says}{_place(error)}. "
            "To publish at the end, begin with rclpy.init(signal_handler_options=SignalHandlerOptions.NO)."
        )
    return f"After the Ctrl-C at the end, {error.callback} ends in {error.type}{error.says}{_place(error)}."


def _place(error: CallbackError) -> str:
    frames = frames_of(error)
    return f" (line {frames[-1][1]})" if frames else ""
