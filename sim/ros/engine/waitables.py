"""A waitable of a student's own class: what it waits for is known to it and to a wait set alone."""

from __future__ import annotations

from typing import Any

from rclpy.context import Context

from sim.ros.rclpy_cpp import cpp


def is_ready(waitable: Any, context: Context) -> bool:
    """Ask it as rclpy's executor does, with a wait set that holds nothing else, without waiting.

    Raises NotImplementedError for one that holds what moves with simulated time.
    """
    sizes = waitable.get_num_entities()
    if sizes.num_timers or sizes.num_subscriptions or sizes.num_events:
        raise NotImplementedError(
            f"{type(waitable).__name__} is a Waitable with a timer, a subscription or a QoS event inside, and"
            " those can't be simulated there: make them with create_timer() and create_subscription(), and"
            " keep guard conditions, services and clients."
        )
    with waitable, context.handle:
        wait_set = cpp.WaitSet(
            0, sizes.num_guard_conditions, 0, sizes.num_clients, sizes.num_services, 0, context.handle
        )
        wait_set.clear_entities()
        waitable.add_to_wait_set(wait_set)
        if sizes.num_guard_conditions or sizes.num_clients or sizes.num_services:
            wait_set.wait(0)  # which refuses an empty one
        return waitable.is_ready(wait_set)
