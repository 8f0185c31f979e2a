"""Nodes that read tracebacks: right ones, and wrong ones named by their defect."""

import itertools
import re

from rclpy.node import Node
from std_msgs.msg import String

PARTS = ("WORKSPACE", "frame")
WORKSPACE = "/home/you/ws/"


def frame(line):
    """The path and the line's number of a frame, such as ("/a/b.py", 31); None for another line."""
    if not line.startswith('  File "'):
        return None
    _, path, rest = line.split('"')
    return path, int(rest.split(",")[1].removeprefix(" line "))


class Reader(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("reader")
        self.publisher = self.create_publisher(String, "/cause", 10)
        self.create_subscription(String, "/crash", self.on_crash, 10)

    def on_crash(self, msg):
        self.publisher.publish(String(data=self.cause(msg.data)))

    def cause(self, text):
        lines = self.lines(text)
        return f"{self.place(lines)} {self.error(lines)}"

    def lines(self, text):
        return [line for line in text.splitlines() if not line.startswith("[")]

    def error(self, lines):
        return next(line for line in reversed(lines) if not line.startswith(" ")).split(":")[0]

    def place(self, lines):
        for found in map(frame, reversed(lines)):
            if found and found[0].startswith(WORKSPACE):
                return self.called(*found)

    def called(self, path, number):
        return f"{path.split('/')[-1]}:{number}"


class ShortNames(Reader):
    """An error's name without its module is right, too."""

    def error(self, lines):
        return super().error(lines).split(".")[-1]


class FromTheTop(Reader):
    """A design of its own: reads on to the end, and keeps what it found last."""

    def cause(self, text):
        place = error = ""
        for line in text.splitlines():
            found = re.match(rf'  File "{WORKSPACE}(?:.*/)?(.+)", line (\d+)', line)
            if found:
                place = f"{found[1]}:{found[2]}"
            elif re.match(r"[A-Za-z][\w.]*(:|$)", line):
                error = line.partition(":")[0]
        return f"{place} {error}"


class InBlocks(Reader):
    """Cuts the text at the last “Traceback”, and that one in two where the indented lines end."""

    def cause(self, text):
        last = text.rpartition("Traceback (most recent call last):\n")[2].splitlines()
        frames = list(itertools.takewhile(lambda line: line.startswith(" "), last))
        return f"{self.place(frames)} {last[len(frames)].split(':')[0]}"


class LowestLine(Reader):
    def place(self, lines):
        return self.called(*[found for found in map(frame, lines) if found][-1])


class HighestLine(Reader):
    def place(self, lines):
        return super().place(lines[::-1])


class MainOnly(Reader):
    """Takes the line with rclpy.spin."""

    def place(self, lines):
        number = next(i for i, line in enumerate(lines) if "in main" in line)
        return self.called(*frame(lines[number]))


class OnlyTheProgram(Reader):
    """Takes a helper's file for one that isn't its own."""

    def place(self, lines):
        return super().place([line for line in lines if "shares.py" not in line])


class FirstTraceback(Reader):
    def lines(self, text):
        return super().lines(text.partition("\n\nDuring handling")[0])


class LastLine(Reader):
    """The very last line, also where it is not the error's."""

    def lines(self, text):
        return text.splitlines()

    def error(self, lines):
        return lines[-1].strip().split(":")[0]


class LastOfSeveral(Reader):
    """Leaves log lines out, and takes the last line of a long text."""

    def error(self, lines):
        return lines[-1].strip().split(":")[0]


class WholeLine(Reader):
    def error(self, lines):
        return next(line for line in reversed(lines) if not line.startswith(" "))


class WholePath(Reader):
    def called(self, path, number):
        return f"{path}:{number}"


class Twice(Reader):
    def on_crash(self, msg):
        super().on_crash(msg)
        super().on_crash(msg)


class Silent(Reader):
    def on_crash(self, msg):
        self.get_logger().info(self.cause(msg.data))
