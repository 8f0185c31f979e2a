"""The process environment that every run needs, set before rclpy or a message package is imported."""

import os
import sys
import tempfile
import warnings

PINNED = {
    # Only OFF keeps two processes with the same topics from hearing each other.
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
    # Shared memory would leave files behind when a process is killed.
    "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
    # Without it `twist.linear.x = 1` silently sends 5e-324 instead of raising.
    "ROS_PYTHON_CHECK_FIELDS": "1",
    "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] [{name}]: {message}",
}
# These can make delivery asynchronous, and a run counts on a message being there when publish() returns.
REMOVED = (
    "RMW_FASTRTPS_PUBLICATION_MODE",
    "RMW_FASTRTPS_USE_QOS_FROM_XML",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "FASTDDS_DEFAULT_PROFILES_FILE",
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
)


def prepare() -> None:
    """Pin the environment of this process. Safe to call again."""
    os.environ.update(PINNED)
    # rclpy says it of a node whose name is none; the error that follows says why.
    warnings.filterwarnings("ignore", "Failed to fini rosout publisher", RuntimeWarning)
    for name in REMOVED:
        os.environ.pop(name, None)
    # rclpy.init() fails where it can't write its log files.
    os.environ.setdefault("ROS_LOG_DIR", os.path.join(tempfile.gettempdir(), f"ros-log-{os.getuid()}"))
    # Where ROS looks for packages' shared files, such as message definitions: here, where pip put them.
    os.environ.setdefault("AMENT_PREFIX_PATH", sys.prefix)
    # For colcon, ros2 and python3 in a cell's `!` and in what they start.
    commands, path = os.path.join(sys.prefix, "bin"), os.environ.get("PATH", os.defpath)
    if commands not in path.split(os.pathsep):
        os.environ["PATH"] = f"{commands}{os.pathsep}{path}"
    for module in list(sys.modules.values()):  # message modules read the switch when they are imported
        if getattr(module, "ros_python_check_fields", None) is not None:
            module.ros_python_check_fields = "1"


def open_to_this_machine(domain: int) -> None:
    """Let other processes on this machine that have the same domain hear this one, from rclpy.init() on."""
    os.environ |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": str(domain)}
