"""rclpy's C++ layer, of which a run uses what has no name in Python: the only module that imports it.

What the supported versions of rclpy do differently there is here, too.
"""

from __future__ import annotations

import re
from typing import Any

from rclpy.impl.implementation_singleton import rclpy_implementation as cpp
from rclpy.qos import qos_profile_default

__all__ = ["NODE_ARGUMENTS", "cpp", "new_node", "takes"]


def takes(name: str, count: int) -> bool:
    """Return whether a C++ function takes so many arguments, by the signature in its docstring."""
    function: Any = cpp
    for part in name.split("."):
        function = getattr(function, part, None)
    signatures = re.findall(r"^(?:\d+\. )?\w+\((.*)\) -> ", getattr(function, "__doc__", None) or "", re.M)
    return any(_fits(signature, count) for signature in signatures)


def _fits(signature: str, count: int) -> bool:
    """Return whether the arguments of one overload, as pybind11 writes them, can be so many."""
    names = re.findall(r"(?:^|, )(\w+): ", signature)
    most = len(names) - names.count("self")
    return most - signature.count(" = ") <= count <= most


# Kilted's nodes have one argument more: the QoS of /rosout, which these nodes have not.
_ROSOUT = (qos_profile_default.get_c_qos_profile(),) if takes("Node.__init__", 7) else ()
NODE_ARGUMENTS = 6 + len(_ROSOUT)


def new_node(name: str, namespace: str, context: Any) -> Any:
    """A node of C++ without /rosout and without global arguments; context: one of C++."""
    return cpp.Node(name, namespace, context, None, False, False, *_ROSOUT)
