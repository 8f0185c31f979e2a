"""The ros2 options that say how messages are printed."""

from __future__ import annotations

from argparse import ArgumentTypeError, Namespace

from sim.ros2.group import argument, flag
from sim.ros2.text import Style


def positive_int(text: str) -> int:
    """The value of an option that must be a positive integer."""
    if not text.isdecimal() or not int(text):
        raise ArgumentTypeError("value must be a positive integer")
    return int(text)


PRINTING = (
    flag("--csv", help="Output all recursive fields separated by commas (e.g. for plotting)"),
    flag("-f", "--full-length", help="Output all elements of arrays, bytes and strings"),
    argument("-l", "--truncate-length", type=positive_int, default=128, help="Their length otherwise"),
    flag("--no-arr", help="Don't print array fields of messages"),
    flag("--no-str", help="Don't print string fields of messages"),
    flag("--flow-style", help="Print collections in one line"),
)


def style_of(options: Namespace) -> Style:
    """Return how these options want a message to be printed."""
    length = None if options.full_length else options.truncate_length
    return Style(length, options.no_arr, options.no_str, options.flow_style)
