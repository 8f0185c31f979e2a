"""A terminal: reads commands, each a JSON list of arguments, and writes their output as JSON."""

import json
import sys

from sim.ros2 import parser
from sim.ros2.live import LiveSystem
from tests.patience import until
from tests.sim.ros2.nodes import known_endpoints


class SharedSystem:
    """One node for all commands, because discovery takes a while."""

    def __init__(self, system):
        self.system = system

    def __enter__(self):
        return self.system

    def __exit__(self, *exception):
        return None


def main():
    command_parser = parser.make_parser()
    output, errors = [], []
    with LiveSystem(output.append, errors.append) as system:
        until(lambda: known_endpoints(system._node) == int(sys.argv[1]), "the nodes")
        for line in sys.stdin:
            arguments = json.loads(line)
            status = parser.execute(
                command_parser, arguments, lambda _: SharedSystem(system), output.append, errors.append
            )
            print(json.dumps({"output": output, "errors": errors, "status": status}), flush=True)
            output.clear()
            errors.clear()


if __name__ == "__main__":
    main()
