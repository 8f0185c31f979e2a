"""A terminal: reads lines, a list of words as JSON each, and writes what ros2 says to them, as JSON."""

import json
import sys

from sim.ros2 import parser
from sim.ros2.live import LiveSystem


class Kept:
    """One node for all commands, for finding the others takes a while."""

    def __init__(self, system):
        self.system = system

    def __enter__(self):
        return self.system

    def __exit__(self, *exception):
        return None


def main():
    command_parser = parser.make_parser()
    said, complained = [], []
    with LiveSystem(said.append, complained.append) as system:
        for line in sys.stdin:
            asked = json.loads(line)
            status = parser.execute(
                command_parser, asked, lambda: Kept(system), said.append, complained.append
            )
            print(json.dumps({"said": said, "complained": complained, "status": status}), flush=True)
            said.clear()
            complained.clear()


if __name__ == "__main__":
    main()
