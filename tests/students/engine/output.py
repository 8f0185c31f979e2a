"""Nodes that write to the screen in every way there is."""

import logging
import os
import subprocess
import sys
import warnings

import rclpy
from rclpy.logging import LoggingSeverity
from rclpy.node import Node


def writes_everywhere():
    rclpy.init()
    node = Node("writer")
    print("printed")
    sys.stdout.write("written\n")
    print("complained", file=sys.stderr)
    os.write(2, b"below python\n")
    logging.getLogger("student").warning("logged by python")
    warnings.warn("warned", stacklevel=1)
    node.get_logger().warn("logged")


def logs_at_every_level():
    rclpy.init()
    node = Node("levels")
    logger = node.get_logger()
    logger.debug("debug")
    logger.info("info")
    logger.warning("warning")
    logger.error("error")
    logger.fatal("fatal")
    logger.set_level(LoggingSeverity.DEBUG)
    logger.debug("now")
    logger.get_child("part").info("child")
    rclpy.logging.get_logger("other").info("not a node's")


def logs_debug_lines():
    rclpy.init()
    Node("levels").get_logger().debug("never asked for")


def runs_a_program():
    rclpy.init()
    subprocess.run(["sh", "-c", "echo child >&2"], check=True)


def odd_texts():
    rclpy.init()
    logger = Node("odd").get_logger()
    for text in ("two\nlines", "äöü €", "%s {} \\", "", "a" * 3000):
        logger.info(text)
    print("no newline", end="")


def logs_a_number():
    rclpy.init()
    Node("odd").get_logger().info(5)


def logs_at_another_level_from_one_line():
    rclpy.init()
    logger = Node("odd").get_logger()
    for level in (logger.info, logger.error):
        level("text")


class PythonLogging(Node):
    """Logs with Python's own logging, once a second."""

    def __init__(self):
        super().__init__("python_logging")
        self.create_timer(1.0, self.tick)

    def tick(self):
        logging.getLogger("output").warning("to stdout, where the notebook set it so")
        logging.getLogger("errors").warning("to stderr")
