"""Every private name and every C++ function of rclpy that a run uses, beside those that the hooks replace.

They are verified when the hooks are installed: a version of rclpy without one of them is refused in a
sentence, instead of failing somewhere in a run.
"""

from __future__ import annotations

from types import ModuleType

import rclpy
import rclpy.context
import rclpy.utilities
from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.client import Client
from rclpy.clock import JumpHandle
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.event_handler import EventHandler
from rclpy.executors import Executor, MultiThreadedExecutor
from rclpy.guard_condition import GuardCondition
from rclpy.impl import rcutils_logger
from rclpy.node import Node
from rclpy.parameter_service import ParameterService
from rclpy.subscription import Subscription
from rclpy.task import Future, Task
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rclpy.timer import Timer
from rclpy.waitable import Waitable

from sim.ros.rclpy_cpp import NODE_ARGUMENTS, cpp, takes

ATTRIBUTES: dict[type, tuple[str, ...]] = {
    ActionClient: (
        *("_action_name", "_action_type", "_client_handle"),
        *("_goal_sequence_number_to_goal_id", "_result_sequence_number_to_goal_id"),
        *("_pending_goal_requests", "_pending_result_requests", "_pending_cancel_requests"),
        *("_is_goal_response_ready", "_is_cancel_response_ready", "_is_result_response_ready"),
        *("_is_feedback_ready", "_is_status_ready"),
    ),
    ActionServer: (
        *("_goal_handles", "_handle", "_lock", "_node", "_result_futures"),
        *("_is_goal_request_ready", "_is_cancel_request_ready", "_is_result_request_ready"),
        "_is_goal_expired",
    ),
    Client: ("_pending_requests",),
    Context: ("_Context__context",),
    Duration: ("_duration_handle",),
    EventHandler: ("_ready_to_take_data",),
    Executor: ("_guard", "_is_shutdown", "_nodes", "_tasks"),
    Future: ("_callbacks", "_set_executor"),
    GuardCondition: ("_executor_triggered",),
    JumpHandle: ("_post_callback", "_pre_callback"),
    MultiThreadedExecutor: ("_executor",),
    Node: (
        *("_allow_undeclared_parameters", "_parameter_overrides", "_parameters"),
        *("_rate_group", "_time_source"),
    ),
    ParameterService: ("_get_node",),
    ServerGoalHandle: ("_action_server", "_goal_handle"),
    Subscription: ("_callback_type",),
    Task: ("_handler",),
    Time: ("_time_handle",),
    TimeSource: ("_associated_clocks", "_clock_sub"),
    Timer: ("_clock",),
    Waitable: ("_futures",),
}
VARIABLES: tuple[tuple[ModuleType, tuple[str, ...]], ...] = (
    (rclpy, ("__executor",)),
    (rclpy.context, ("g_logging_ref_count",)),
    (rclpy.utilities, ("g_default_context",)),
    (rcutils_logger, ("_find_caller", "_internal_callers")),
    (cpp, ("RCL_DEFAULT_DOMAIN_ID", "RCLError", "RMWError", "UnsupportedEventTypeError")),
)
# C++ functions, with the number of arguments that they are called with; `self` doesn't count.
FUNCTIONS: dict[str, int] = {
    "ActionServer.expire_goals": 1,
    "Client.__init__": 4,
    "Client.send_request": 1,
    "Client.take_response": 1,
    "Clock.set_ros_time_override": 1,
    "Clock.set_ros_time_override_is_enabled": 1,
    "Destroyable.destroy_when_not_in_use": 0,
    "Node.__init__": NODE_ARGUMENTS,
    "Publisher.__init__": 4,
    "Publisher.publish_raw": 1,
    "Publisher.wait_for_all_acked": 1,
    "Service.__init__": 4,
    "Service.service_send_response": 2,
    "Service.service_take_request": 1,
    "Subscription.__init__": 4,
    "Subscription.take_message": 2,
    "Timer.call_timer": 0,
    "Timer.is_timer_canceled": 0,
    "Timer.is_timer_ready": 0,
    "Timer.time_until_next_call": 0,
    "TypeDescriptionService.__init__": 1,
    "WaitSet.__init__": 7,
    "WaitSet.clear_entities": 0,
    "WaitSet.wait": 1,
    "rclpy_get_publishers_info_by_topic": 3,
    "rclpy_get_subscriptions_info_by_topic": 3,
    "rclpy_logging_get_logger_level": 1,
    "rclpy_logging_set_logger_level": 2,
    "rclpy_remove_ros_args": 1,
    "rclpy_serialize": 2,
}


def missing() -> list[str]:
    """The names of all this that the installed rclpy does not have, or has in another form."""
    found = []
    for owner, names in ATTRIBUTES.items():
        known = _attributes(owner)
        found += [f"{owner.__module__}.{owner.__qualname__}.{name}" for name in names if name not in known]
    for module, names in VARIABLES:
        found += [f"{module.__name__}.{name}" for name in names if name not in vars(module)]
    changed = [name for name, count in FUNCTIONS.items() if not takes(name, count)]
    return found + [f"{cpp.__name__}.{name}" for name in changed]


def _attributes(owner: type) -> set[str]:
    """The attributes of a class, and all that its methods use: those of its objects are among them."""
    found = set(dir(owner))
    for member in (member for kind in owner.__mro__ for member in vars(kind).values()):
        for function in (member, getattr(member, "fget", None), getattr(member, "fset", None)):
            found.update(getattr(getattr(function, "__code__", None), "co_names", ()))
    return found
