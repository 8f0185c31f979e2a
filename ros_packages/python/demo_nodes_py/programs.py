"""What the main() functions of the demo nodes have in common."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, QoSReliabilityPolicy, qos_profile_sensor_data
from rclpy.utilities import remove_ros_args

RELIABLE_DEPTH = 10
CYCLES = 20


def spin_node(make_node: Callable[[], Node], args: Sequence[str] | None) -> None:
    """Make a node and spin it until Ctrl-C."""
    rclpy.init(args=args)
    node = make_node()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def spin_cycles(
    make_node: Callable[[QoSProfile], Node], cycles_help: str, argv: Sequence[str] | None
) -> None:
    """Make a node with the quality of service in the arguments, and call as many callbacks as they say."""
    arguments = sys.argv[1:] if argv is None else argv
    parser = argparse.ArgumentParser(formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--reliable", action="store_true", help="set qos profile to reliable")
    parser.add_argument("-n", "--number_of_cycles", type=int, default=CYCLES, help=cycles_help)
    options = parser.parse_args(remove_ros_args(args=arguments))
    rclpy.init(args=arguments)
    reliable = QoSProfile(depth=RELIABLE_DEPTH, reliability=QoSReliabilityPolicy.RELIABLE)
    node = make_node(reliable if options.reliable else qos_profile_sensor_data)
    cycles = 0
    try:
        while rclpy.ok() and cycles < options.number_of_cycles:
            rclpy.spin_once(node)
            cycles += 1
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def reliability_name(qos: QoSProfile) -> str:
    """ "Reliable" or "Best effort"."""
    return "Reliable" if qos.reliability is QoSReliabilityPolicy.RELIABLE else "Best effort"
