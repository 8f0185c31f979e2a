"""Motors: right ones in different designs, and wrong ones named after their defect."""

import threading
import time

import rclpy
from geometry_msgs.msg import Twist
from lifecycle_msgs.msg import TransitionEvent
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, ManagedEntity, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future

PARTS = "Wheels", "Wheel", "Managed"
SUCCESS, FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


class Motor(LifecycleNode):
    """Nothing is wrong with it; many of the others change one thing each."""

    def __init__(self):
        super().__init__("motor")
        self.declare_parameter("speed", 0.0)
        self.commands, self.timer = None, None

    def read(self):
        return self.get_parameter("speed").value

    def on_configure(self, state):
        self.speed = self.read()
        if not 0.0 < self.speed <= 0.5:
            self.get_logger().error(f"{self.speed} m/s is no speed for this motor")
            return FAILURE
        self.commands = self.create_lifecycle_publisher(Twist, "/cmd_vel", 10)
        return SUCCESS

    def on_activate(self, state):
        self.timer = self.create_timer(0.1, self.drive)
        return super().on_activate(state)

    def on_deactivate(self, state):
        self.stop()
        return super().on_deactivate(state)

    def drive(self):
        command = Twist()
        command.linear.x = self.speed
        if self.commands is not None:
            self.commands.publish(command)

    def stop(self):
        if self.timer is not None:
            self.destroy_timer(self.timer)
            self.timer = None
            self.commands.publish(Twist())

    def release(self, state):
        self.stop()
        if self.commands is not None:
            self.destroy_lifecycle_publisher(self.commands)
            self.commands = None
        return SUCCESS

    on_cleanup = on_shutdown = on_error = release


class StartsAndStopsItsTimer(LifecycleNode):
    """One timer for the node's whole life, which is canceled and reset; an ordinary publisher."""

    def __init__(self):
        super().__init__("motor")
        self.declare_parameter("speed", 0.0)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.command = Twist()
        self.timer = self.create_timer(0.1, lambda: self.publisher.publish(self.command), autostart=False)

    def on_configure(self, state):
        speed = self.get_parameter("speed").get_parameter_value().double_value
        if speed <= 0.0 or speed > 0.5:
            return FAILURE
        self.command.linear.x = speed
        return SUCCESS

    def on_activate(self, state):
        self.timer.reset()
        return SUCCESS

    def on_deactivate(self, state):
        self.timer.cancel()
        self.publisher.publish(Twist())
        return SUCCESS

    on_shutdown = on_deactivate


class AsksWhetherItIsActive(StartsAndStopsItsTimer):
    """The timer always runs, and a flag says whether it may drive; while it may not, zeros are sent."""

    def __init__(self):
        super().__init__()
        self.active = False
        self.timer = self.create_timer(0.1, self.tick)

    def tick(self):
        self.publisher.publish(self.command if self.active else Twist())

    def on_activate(self, state):
        self.active = True
        return SUCCESS

    def on_deactivate(self, state):
        self.active = False
        self.publisher.publish(Twist())
        return SUCCESS

    on_shutdown = on_deactivate


class MadeWhenConfigured(Motor):
    """Publisher and timer from configure to cleanup: while it is inactive, the publisher publishes nothing."""

    def on_configure(self, state):
        result = super().on_configure(state)
        if result == SUCCESS:
            self.timer = self.create_timer(0.1, self.drive)
        return result

    def on_activate(self, state):
        return LifecycleNode.on_activate(self, state)

    def on_deactivate(self, state):
        self.commands.publish(Twist())
        return LifecycleNode.on_deactivate(self, state)


class Wheels(ManagedEntity):
    """A part of a node that has a lifecycle itself."""

    def __init__(self, node):
        self.node, self.timer = node, None
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def on_configure(self, state):
        self.speed = self.node.get_parameter("speed").value
        return SUCCESS if 0.0 < self.speed <= 0.5 else FAILURE

    def on_activate(self, state):
        self.timer = self.node.create_timer(0.1, self.drive)
        return SUCCESS

    def on_deactivate(self, state):
        if self.timer:
            self.node.destroy_timer(self.timer)
            self.timer = None
            self.publisher.publish(Twist())
        return SUCCESS

    on_cleanup = on_shutdown = on_error = on_deactivate

    def drive(self):
        command = Twist()
        command.linear.x = self.speed
        self.publisher.publish(command)


def managed_entity():
    """A design of its own: a managed entity does the work, and the node only passes the transitions on."""
    node = LifecycleNode("motor")
    node.declare_parameter("speed", 0.0)
    node.add_managed_entity(Wheels(node))
    return node


def main():
    rclpy.init()
    node = Motor()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


class OneMoreZero(Motor):
    """The device is slow: it begins at once when activated, and repeats the zero before it rests."""

    def on_activate(self, state):
        result = super().on_activate(state)
        self.drive()
        time.sleep(0.3)
        return result

    def stop(self):
        if self.timer is not None:
            self.timer.cancel()
            for _ in range(3):
                self.commands.publish(Twist())
                time.sleep(0.05)
        super().stop()


class InAThread(LifecycleNode):
    """A thread per activation, as in drivers that wait for their device; an event ends it."""

    def __init__(self):
        super().__init__("motor")
        self.declare_parameter("speed", 0.1)
        self.pub, self.thread = self.create_publisher(Twist, "cmd_vel", 10), None

    def on_configure(self, state):
        self.command = Twist()
        self.command.linear.x = self.get_parameter("speed").value
        return SUCCESS if 0.0 < self.command.linear.x <= 0.5 else FAILURE

    def on_activate(self, state):
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.thread.start()
        return SUCCESS

    def work(self):
        while not self.ended.is_set():
            self.pub.publish(self.command)
            self.ended.wait(0.1)

    def on_deactivate(self, state):
        if self.thread is not None:
            self.ended.set()
            self.thread.join()
            self.thread = None
        self.pub.publish(Twist())
        return SUCCESS

    on_shutdown = on_error = on_deactivate


class RefusesWhenItIsSet(Motor):
    """A design of its own: a range makes the parameter refuse a wrong speed, long before it is configured."""

    def __init__(self):
        LifecycleNode.__init__(self, "motor")
        allowed = FloatingPointRange(from_value=0.01, to_value=0.5)
        self.declare_parameter("speed", 0.1, ParameterDescriptor(floating_point_range=[allowed]))
        self.commands, self.timer = None, None


class ChangesOnlyAtRest(Motor):
    """Refuses a change of the parameter while it is active: the old speed holds for the second round, too."""

    def __init__(self):
        super().__init__()
        self.add_on_set_parameters_callback(self.on_change)

    def on_change(self, parameters):
        return SetParametersResult(successful=self.timer is None, reason="the motor is running")


class Wheel(Node):
    """A second node of the program: it drives as fast as the first one says."""

    def __init__(self):
        super().__init__("wheel")
        self.speed = None
        self.pub = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        if self.speed is not None:
            command = Twist()
            command.linear.x = self.speed
            self.pub.publish(command)


class Managed(LifecycleNode):
    """A state machine in a table: each transition gives the wheel its speed, and the rest is the wheel's."""

    def __init__(self, wheel):
        self.wheel, self.configured = wheel, None
        super().__init__("motor", allow_undeclared_parameters=True)

    def on_configure(self, state):
        speed = self.get_parameter_or("speed", Parameter("speed", value=0.0)).value
        if not 0.0 < speed <= 0.5:
            return FAILURE
        self.configured = speed
        return SUCCESS

    def on_activate(self, state):
        self.wheel.speed = self.configured
        return SUCCESS

    def on_deactivate(self, state):
        self.wheel.speed = None
        self.wheel.pub.publish(Twist())
        return SUCCESS

    on_shutdown = on_deactivate


def two_nodes_in_threads():
    rclpy.init()
    wheel = Wheel()
    executor = MultiThreadedExecutor()
    executor.add_node(wheel)
    executor.add_node(Managed(wheel))
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()


class InACoroutine(StartsAndStopsItsTimer):
    """A task of the executor, which awaits the next tick while it is active."""

    def __init__(self):
        super().__init__()
        self.timer = self.create_timer(0.1, self.tick)
        self.next, self.active = Future(), False

    def tick(self):
        done, self.next = self.next, Future()
        done.set_result(None)

    async def work(self):
        while self.active:
            self.publisher.publish(self.command)
            await self.next

    def on_activate(self, state):
        self.active = True
        self.executor.create_task(self.work)
        return SUCCESS

    def on_deactivate(self, state):
        self.active = False
        self.publisher.publish(Twist())
        return SUCCESS

    on_shutdown = on_deactivate


class AnErrorForAWrongSpeed(Motor):
    """A transition fails with ERROR, too, and on_error takes the node back to unconfigured."""

    def on_configure(self, state):
        result = super().on_configure(state)
        return TransitionCallbackReturn.ERROR if result == FAILURE else result


class ListensToItself(Motor):
    """Reads its states from its own /motor/transition_event."""

    def __init__(self):
        super().__init__()
        self.active = False
        self.create_subscription(TransitionEvent, "~/transition_event", self.on_event, 10)
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        if self.active:
            self.drive()

    def on_event(self, event):
        was, self.active = self.active, event.goal_state.label == "active"
        if was and not self.active:
            self.commands.publish(Twist())

    def on_configure(self, state):
        self.speed = self.read()
        return SUCCESS if 0.0 < self.speed <= 0.5 else FAILURE

    def on_activate(self, state):
        return SUCCESS

    on_deactivate = on_cleanup = on_shutdown = on_activate


class ReadsInInit(Motor):
    """Too early: no one has set it yet."""

    def __init__(self):
        super().__init__()
        self.first = self.get_parameter("speed").value or 0.2

    def read(self):
        return self.first


class ReadsInActivate(Motor):
    """Too late."""

    def on_activate(self, state):
        self.speed = self.read()
        return super().on_activate(state)


class NoZeros(Motor):
    def on_deactivate(self, state):
        self.destroy_timer(self.timer)
        return LifecycleNode.on_deactivate(self, state)


class ZerosTooLate(Motor):
    """The publisher is off already."""

    def on_deactivate(self, state):
        result = LifecycleNode.on_deactivate(self, state)
        self.stop()
        return result


class OrdinaryPublisherAndTimer(Motor):
    """Drives while it is inactive: nothing stops the timer, and the publisher knows no states."""

    def on_configure(self, state):
        self.speed = self.read()
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.timer = self.create_timer(0.1, self.drive)
        return SUCCESS if 0.0 < self.speed <= 0.5 else FAILURE

    def on_activate(self, state):
        return SUCCESS

    def on_deactivate(self, state):
        return SUCCESS


class DrivesAtOnce(Motor):
    """Doesn't wait until it is activated."""

    def on_configure(self, state):
        result = super().on_configure(state)
        if result == SUCCESS:
            self.commands.on_activate(state)
            self.timer = self.create_timer(0.1, self.drive)
        return result

    def on_activate(self, state):
        return LifecycleNode.on_activate(self, state)


class TwoTimers(Motor):
    """Each activation adds one."""

    def on_deactivate(self, state):
        self.commands.publish(Twist())
        return LifecycleNode.on_deactivate(self, state)


class NoCleanup(Motor):
    """The publisher and the timer of the first round stay."""

    def on_configure(self, state):
        result = super().on_configure(state)
        if result == SUCCESS:
            self.timer = self.create_timer(0.1, self.drive)
        return result

    def on_activate(self, state):
        return LifecycleNode.on_activate(self, state)

    def on_deactivate(self, state):
        self.commands.publish(Twist())
        return LifecycleNode.on_deactivate(self, state)

    def on_cleanup(self, state):
        return SUCCESS


class ConfiguresOnlyOnce(Motor):
    """What is there already is taken for a mistake."""

    def on_configure(self, state):
        if self.commands is not None:
            return FAILURE
        return super().on_configure(state)

    def on_cleanup(self, state):
        return SUCCESS


class BreaksInTheSecondRound(Motor):
    """The parameter is declared when it is configured, and again."""

    def __init__(self):
        LifecycleNode.__init__(self, "motor")
        self.declare_parameter("speed", 0.0)
        self.commands, self.timer = None, None

    def on_configure(self, state):
        self.declare_parameter("round", 1)
        return super().on_configure(state)


class ForgetsSuper(Motor):
    """The publisher doesn't learn that the node is active."""

    def on_activate(self, state):
        self.timer = self.create_timer(0.1, self.drive)
        return SUCCESS


class ForgetsReturn(Motor):
    def on_configure(self, state):
        super().on_configure(state)


class TakesAnySpeed(Motor):
    def on_configure(self, state):
        self.speed = self.read()
        self.commands = self.create_lifecycle_publisher(Twist, "/cmd_vel", 10)
        return SUCCESS


class RefusesEverything(Motor):
    def on_configure(self, state):
        return FAILURE


class DrivesOnAfterTheShutdown(Motor):
    def on_shutdown(self, state):
        return SUCCESS


class OrdinaryNode(Node):
    def __init__(self):
        super().__init__("motor")
        self.declare_parameter("speed", 0.2)
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x = self.get_parameter("speed").value
        self.commands.publish(command)


class AnotherName(Motor):
    def __init__(self):
        LifecycleNode.__init__(self, "motors")
        self.declare_parameter("speed", 0.0)
        self.commands, self.timer = None, None


class TwiceAsOften(Motor):
    def create_timer(self, period, callback):
        return super().create_timer(period / 2, callback)


class SwapsTheAxes(Motor):
    def drive(self):
        command = Twist()
        command.angular.z = self.speed
        self.commands.publish(command)


class SpeedWithATurn(Motor):
    """Drives a circle; what it calls stopping is a turn on the spot."""

    turn = 0.4

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = self.speed, self.turn
        self.commands.publish(command)


class TurnsOnTheSpotToStop(Motor):
    def stop(self):
        if self.timer is not None:
            self.destroy_timer(self.timer)
            self.timer = None
            command = Twist()
            command.angular.z = 0.5
            self.commands.publish(command)


class DeclaresWhenConfigured(Motor):
    """No one can set it before."""

    def __init__(self):
        LifecycleNode.__init__(self, "motor")
        self.commands, self.timer = None, None

    def on_configure(self, state):
        if not self.has_parameter("speed"):
            self.declare_parameter("speed", 0.2)
        return super().on_configure(state)


class LoopsInActivate(Motor):
    """The loop waits for a deactivate that can't come while it runs."""

    def on_activate(self, state):
        LifecycleNode.on_activate(self, state)
        self.running = True
        while self.running:
            self.drive()
            time.sleep(0.1)
        return SUCCESS

    def stop(self):
        self.running = False


class WithoutTheState(Motor):
    """A method that takes no state can't be called."""

    def on_configure(self):
        return super().on_configure(None)


class ReturnsTrue(Motor):
    def on_configure(self, state):
        return super().on_configure(state) == SUCCESS


class RaisesForAWrongSpeed(Motor):
    """An exception is an ERROR; on_error takes the node back to unconfigured."""

    def on_configure(self, state):
        if not 0.0 < self.read() <= 0.5:
            raise ValueError("no speed for this motor")
        return super().on_configure(state)


class StopsWhenCleanedUp(Motor):
    """Thinks that inactive means out of use, not standing."""

    def on_deactivate(self, state):
        self.destroy_timer(self.timer)
        return LifecycleNode.on_deactivate(self, state)

    def on_cleanup(self, state):
        LifecycleNode.on_activate(self, state)
        return self.release(state)


class RefusesEveryChange(Motor):
    """A parameter that no one can set."""

    def __init__(self):
        LifecycleNode.__init__(self, "motor")
        self.declare_parameter("speed", 0.2, ParameterDescriptor(read_only=True))
        self.commands, self.timer = None, None
