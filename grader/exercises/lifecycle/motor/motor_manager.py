"""A manager that takes a student's lifecycle node /motor through its states."""

from __future__ import annotations

import random
from functools import partial

from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.srv import SetParameters
from rclpy.task import Future

from grader.companions.service_clients import ServiceCaller, call_at, set_parameter

CHANGE, SET = "/motor/change_state", "/motor/set_parameters"
MOST_SPEED = 0.5  # m/s; a motor refuses more


class MotorManager(ServiceCaller):
    """Requests the transitions of a plan, and sets the parameter `speed`, which is a number in the plan."""

    def __init__(self) -> None:
        super().__init__("manager")
        self.change = self.create_client(ChangeState, CHANGE)
        self.setting = self.create_client(SetParameters, SET)
        moment = 0.5
        for step in self.plan():
            moment += random.uniform(0.3, 0.5)
            call_at(self, moment, partial(self.do, step))
            moment += random.uniform(0.9, 1.3) if step == "activate" else 0.0

    def plan(self) -> list[str | float]:
        """Return two rounds: in the first one the speed is changed too late, and it is activated twice."""
        first, second = random.randint(100, 180) / 1000, random.randint(220, 300) / 1000
        if random.random() < 0.5:
            first, second = second, first
        return [first, "configure", "activate", second, "deactivate", "activate", "deactivate", "cleanup",
                "configure", "activate", "shutdown"]  # fmt: skip

    def do(self, step: str | float) -> None:
        """Set the speed, or request a transition."""
        if isinstance(step, float):
            set_parameter(self, self.setting, "speed", step)
            return
        request = ChangeState.Request()
        request.transition.label = step
        self.change.call_async(request).add_done_callback(partial(self.on_response, step))

    def on_response(self, step: str, future: Future) -> None:
        """Log whether the transition has succeeded."""
        self.get_logger().info(f"{step}: {'done' if future.result().success else 'failed'}")


class StrictManager(MotorManager):
    """Tries to configure it with three speeds that no motor takes, then with the highest one that it does.

    If one of the three was refused as a parameter already, it is configured with another one, and cleaned up.
    """

    right = False

    def plan(self) -> list[str | float]:
        """Return the one plan of this manager."""
        wrong = [random.randint(60, 90) / 100, -random.randint(10, 40) / 100, 0.0]
        random.shuffle(wrong)
        tries = [step for speed in (*wrong, MOST_SPEED) for step in (speed, "configure")]
        return [*tries, "activate", "deactivate"]

    def do(self, step: str | float) -> None:
        """Remember which speed it is."""
        self.right = step == MOST_SPEED if isinstance(step, float) else self.right
        super().do(step)

    def on_response(self, step: str, future: Future) -> None:
        """Return to unconfigured before the next speed."""
        super().on_response(step, future)
        if step == "configure" and future.result().success and not self.right:
            self.do("cleanup")
