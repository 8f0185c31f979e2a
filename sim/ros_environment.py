"""Sets the environment variables that rclpy needs; called before rclpy or a message package is imported."""

import os
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any

from sim.ros_libraries import load_libraries, site_packages

PINNED = {
    # Only OFF keeps two processes with the same topics from receiving each other's messages.
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
    # Shared memory would leave files behind when a process is killed.
    "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
    # Without it `twist.linear.x = 1` silently sends 5e-324 instead of raising.
    "ROS_PYTHON_CHECK_FIELDS": "1",
    "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] [{name}]: {message}",
}
# These can make delivery asynchronous, but a run needs each message delivered when publish() returns.
REMOVED = (
    "RMW_FASTRTPS_PUBLICATION_MODE",
    "RMW_FASTRTPS_USE_QOS_FROM_XML",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "FASTDDS_DEFAULT_PROFILES_FILE",
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
)


def prepare() -> None:
    """Set and remove environment variables of this process. Idempotent."""
    os.environ.update(PINNED)
    # rclpy warns about this for a node with an invalid name; the exception that follows has the reason.
    warnings.filterwarnings("ignore", "Failed to fini rosout publisher", RuntimeWarning)
    for name in REMOVED:
        os.environ.pop(name, None)
    # rclpy.init() fails if it can't write its log files.
    os.environ.setdefault("ROS_LOG_DIR", os.path.join(tempfile.gettempdir(), f"ros-log-{os.getuid()}"))
    os.environ.setdefault("AMENT_PREFIX_PATH", _prefix())
    load_libraries()
    # A process that was started before a wheel was installed has not read its ros2_course.pth.
    beside = str(Path(__file__).parents[1] / "ros2_course" / "ros_packages" / "python")
    if beside not in sys.path and os.path.isdir(beside):
        sys.path.append(beside)
    # So that a cell's `!` finds colcon, ros2 and python3, and so do their child processes.
    commands, path = os.path.join(sys.prefix, "bin"), os.environ.get("PATH", os.defpath)
    if commands not in path.split(os.pathsep):
        os.environ["PATH"] = f"{commands}{os.pathsep}{path}"
    module: Any
    for module in list(sys.modules.values()):  # message modules read the variable when they are imported
        if getattr(module, "ros_python_check_fields", None) is not None:
            module.ros_python_check_fields = "1"


def _prefix() -> str:
    """The prefix under which pip installed shared files of ROS packages, such as message definitions."""
    # PREFIX/lib/python3.12/site-packages: a system's pip may have another prefix than its Python. Nothing
    # is imported for it: during an import, Ctrl-C ends in a traceback.
    site = site_packages()
    return str(site.parents[2]) if site else sys.prefix


def open_to_this_machine(domain: int) -> None:
    """Let processes on this machine with the same domain discover this one, from rclpy.init() on."""
    os.environ |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(domain)}
