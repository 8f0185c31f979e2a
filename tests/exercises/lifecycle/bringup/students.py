"""Bringups: right ones, and wrong ones named after their defect."""

import threading

import rclpy
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger

NODES = ("sensor", "filter", "controller")
GOALS = {"configure": "inactive", "activate": "active", "shutdown": "finalized"}
PLAN = [(label, name) for label in ("configure", "activate") for name in NODES]
PARTS = ("request_of",)


def request_of(label):
    request = ChangeState.Request()
    request.transition.label = label
    return request


class Bringup(Node):
    """Nothing is wrong with it; many of the others change one thing each."""

    tries = 3

    def __init__(self):
        super().__init__("bringup")
        group = self.make_group()
        self.managed = {
            name: self.create_client(ChangeState, f"/{name}/change_state", callback_group=group)
            for name in NODES
        }
        self.create_service(Trigger, "/bringup/shutdown", self.on_shutdown, callback_group=group)
        self.timer = self.create_timer(0.2, self.start, callback_group=group)

    def make_group(self):
        return ReentrantCallbackGroup()

    async def start(self):
        if all(client.service_is_ready() for client in self.managed.values()):
            self.timer.cancel()
            await self.bring_up()

    async def change(self, name, label):
        response = await self.managed[name].call_async(request_of(label))
        return response.success

    async def try_to(self, name, label):
        for _ in range(self.tries):
            if await self.change(name, label):
                return True
        return False

    async def bring_up(self):
        for label, name in PLAN:
            if not await self.try_to(name, label):
                self.get_logger().error(f"/{name}: {label} has failed three times")
                await self.shut_down()
                return

    async def shut_down(self):
        for name in reversed(NODES):
            await self.change(name, "shutdown")

    async def on_shutdown(self, request, response):
        await self.shut_down()
        response.success = True
        return response


class DoneCallbacks(Node):
    """A list of what is left to do; the callback of each response sends the next request."""

    def __init__(self):
        super().__init__("bringup")
        self.managed = {name: self.create_client(ChangeState, f"/{name}/change_state") for name in NODES}
        self.create_service(Trigger, "/bringup/shutdown", self.on_shutdown)
        self.plan, self.failures, self.waiting = list(PLAN), 0, False
        self.timer = self.create_timer(0.1, self.start)

    def start(self):
        if all(client.service_is_ready() for client in self.managed.values()):
            self.timer.cancel()
            self.next()

    def next(self):
        if self.plan:
            self.waiting, (label, name) = True, self.plan[0]
            future = self.managed[name].call_async(request_of(label))
            future.add_done_callback(lambda future: self.on_response(label, name, future))

    def on_response(self, label, name, future):
        self.waiting = False
        if self.plan[:1] == [(label, name)]:  # else a shutdown has changed the plan
            self.judge(label, name, future.result().success)
        self.next()

    def judge(self, label, name, success):
        if success or label == "shutdown":
            self.plan, self.failures = self.plan[1:], 0
        else:
            self.failures += 1
            if self.failures == 3:
                self.get_logger().error(f"{name} failed to {label}")
                self.plan = [("shutdown", each) for each in reversed(NODES)]

    def on_shutdown(self, request, response):
        self.plan = [("shutdown", each) for each in reversed(NODES)]
        if not self.waiting:
            self.next()
        response.success = True
        return response


class StateMachine(Node):
    """A timer looks whether the future is done, and sends the next request; it waits before it tries again."""

    def __init__(self):
        super().__init__("bringup")
        self.managed = {name: self.create_client(ChangeState, f"/{name}/change_state") for name in NODES}
        self.create_service(Trigger, "/bringup/shutdown", self.on_shutdown)
        self.plan, self.future, self.failures, self.pause = list(PLAN), None, 0, 0
        self.sent = None
        self.create_timer(0.05, self.tick)

    def tick(self):
        self.pause -= 1
        if self.pause > 0 or not self.plan:
            return
        label, name = self.plan[0]
        if self.future is None:
            if self.managed[name].service_is_ready():
                self.sent, self.future = (label, name), self.managed[name].call_async(request_of(label))
        elif self.future.done():
            success, self.future = self.future.result().success, None
            if self.sent != (label, name):
                return  # a shutdown has changed the plan
            if success or label == "shutdown":
                self.plan.pop(0)
                self.failures = 0
            else:
                self.failed(name)

    def failed(self, name):
        self.failures += 1
        self.pause = 10
        if self.failures >= 3:
            self.get_logger().error(f"{name} is broken")
            self.plan = [("shutdown", each) for each in NODES[::-1]]

    def on_shutdown(self, request, response):
        self.plan = [("shutdown", each) for each in NODES[::-1]]
        response.success = True
        return response


def main():
    """A main that waits outside of callbacks, and ends when all is shut down."""
    rclpy.init()
    node = Node("bringup")
    managed = {name: node.create_client(ChangeState, f"/{name}/change_state") for name in NODES}
    ended = Future()

    def on_shutdown(request, response):
        ended.set_result(True)
        response.success = True
        return response

    def change(name, label):
        future = managed[name].call_async(request_of(label))
        rclpy.spin_until_future_complete(node, future)
        return future.result().success

    node.create_service(Trigger, "/bringup/shutdown", on_shutdown)
    for client in managed.values():
        while not client.wait_for_service(timeout_sec=1.0):
            node.get_logger().info("waiting")
    for label, name in PLAN:
        if not any(change(name, label) for _ in range(3)):
            node.get_logger().error(f"/{name} can't be brought up: {label} failed")
            break
    else:
        rclpy.spin_until_future_complete(node, ended)
    for name in reversed(NODES):
        change(name, "shutdown")
    node.destroy_node()
    rclpy.shutdown()


class BlocksItsOnlyThread(Node):
    """Waits in its callbacks, and needs the executor of `two_groups_main` for it."""

    def __init__(self):
        super().__init__("bringup")
        clients, own = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.managed = {
            name: self.create_client(ChangeState, f"/{name}/change_state", callback_group=clients)
            for name in NODES
        }
        self.create_service(Trigger, "/bringup/shutdown", self.on_shutdown, callback_group=own)
        self.timer = self.create_timer(0.1, self.bring_up, callback_group=own)

    def change(self, name, label):
        return self.managed[name].call(request_of(label)).success

    def bring_up(self):
        self.timer.cancel()
        for client in self.managed.values():
            client.wait_for_service()
        for label, name in PLAN:
            if not any(self.change(name, label) for _ in range(3)):
                self.get_logger().error(f"{name} doesn't {label}")
                self.shut_down()
                return

    def shut_down(self):
        for name in reversed(NODES):
            self.change(name, "shutdown")

    def on_shutdown(self, request, response):
        self.shut_down()
        return Trigger.Response(success=True, message="all three are shut down")


def two_groups_main():
    """Clients in a group of their own, and an executor of several threads: then callbacks may wait."""
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(BlocksItsOnlyThread())
    executor.spin()


def thread_main():
    """Spins in a thread of its own, and waits in the main one."""
    rclpy.init()
    node, ended = Node("bringup"), threading.Event()
    managed = {name: node.create_client(ChangeState, f"/{name}/change_state") for name in NODES}

    def on_shutdown(request, response):
        ended.set()
        response.success = True
        return response

    node.create_service(Trigger, "/bringup/shutdown", on_shutdown)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for client in managed.values():
        client.wait_for_service()
    for label, name in PLAN:
        if not any(managed[name].call(request_of(label)).success for _ in range(3)):
            node.get_logger().error(f"{name}: {label}")
            ended.set()
            break
    ended.wait()
    for name in reversed(NODES):
        managed[name].call(request_of("shutdown"))


class ReadsStates(Bringup):
    """A design of its own: it reads the state with get_state after each request, and believes only that."""

    def __init__(self):
        super().__init__()
        group = ReentrantCallbackGroup()
        self.readers = {
            name: self.create_client(GetState, f"/{name}/get_state", callback_group=group) for name in NODES
        }

    async def change(self, name, label):
        await self.managed[name].call_async(request_of(label))
        response = await self.readers[name].call_async(GetState.Request())
        return response.current_state.label == GOALS[label]


class Numbers(Bringup):
    """Requests transitions by their numbers, and goes down state by state, as nav2's manager does."""

    async def request(self, name, number):
        request = ChangeState.Request()
        request.transition.id = number
        return (await self.managed[name].call_async(request)).success

    async def change(self, name, label):
        up = label == "activate"
        return await self.request(
            name, Transition.TRANSITION_ACTIVATE if up else Transition.TRANSITION_CONFIGURE
        )

    async def shut_down(self):
        for number in (
            Transition.TRANSITION_DEACTIVATE,
            Transition.TRANSITION_CLEANUP,
            Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
        ):
            for name in NODES[::-1]:
                await self.request(name, number)


class FollowsEvents(DoneCallbacks):
    """A design of its own: /transition_event says that a node has got there, the response that it hasn't."""

    def __init__(self):
        super().__init__()
        for name in NODES:
            topic = f"/{name}/transition_event"
            self.create_subscription(TransitionEvent, topic, lambda msg, name=name: self.on_event(name, msg), 10)

    def on_event(self, name, event):
        if self.plan and name == self.plan[0][1] and event.goal_state.label == GOALS[self.plan[0][0]]:
            self.plan, self.failures = self.plan[1:], 0
            self.next()

    def on_response(self, label, name, future):
        if not future.result().success and self.plan[:1] == [(label, name)]:
            super().on_response(label, name, future)

    def on_shutdown(self, request, response):
        self.waiting = False
        return super().on_shutdown(request, response)


class Steps(Node):
    """A design of its own: a generator yields the requests, and is sent the responses."""

    def __init__(self):
        super().__init__("bringup")
        self.managed = {name: self.create_client(ChangeState, f"/{name}/change_state") for name in NODES}
        self.create_service(Trigger, "/bringup/shutdown", self.on_shutdown)
        self.timer = self.create_timer(0.3, self.begin)

    def begin(self):
        self.timer.cancel()
        self.follow(self.up())

    def up(self):
        for label, name in PLAN:
            failures = 0
            while not (yield name, label):
                failures += 1
                if failures == 3:
                    self.get_logger().error(f"{name} failed")
                    yield from self.down()
                    return

    def down(self):
        for name in reversed(NODES):
            yield name, "shutdown"

    def follow(self, plan, answer=None):
        try:
            name, label = plan.send(answer)
        except StopIteration:
            return
        future = self.managed[name].call_async(request_of(label))
        future.add_done_callback(lambda future: self.follow(plan, future.result().success))

    def on_shutdown(self, request, response):
        self.follow(self.down())
        response.success = True
        return response


def task_main():
    """A design of its own: the bringup is a task of the executor, and no callback."""
    rclpy.init()
    node = Bringup()
    node.timer.cancel()
    for client in node.managed.values():
        client.wait_for_service()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.create_task(node.bring_up())
    executor.spin()


class PausesBetweenTries(Bringup):
    async def try_to(self, name, label):
        for number in range(3):
            if number:
                await self.pause(0.5)
            if await self.change(name, label):
                return True
        return False

    async def pause(self, seconds):
        over = Future()
        timer = self.create_timer(
            seconds, lambda: over.done() or over.set_result(True), callback_group=ReentrantCallbackGroup()
        )
        await over
        self.destroy_timer(timer)


class DownStateByState(Bringup):
    """Each node goes down all the way before the next one begins to."""

    async def shut_down(self):
        for name in reversed(NODES):
            for label in ("deactivate", "cleanup", "shutdown"):
                await self.change(name, label)


class IgnoresSuccess(Bringup):
    async def try_to(self, name, label):
        await self.change(name, label)
        return True


class ReturnsTheResponse(Bringup):
    """A response is always true."""

    async def change(self, name, label):
        return await self.managed[name].call_async(request_of(label))


class GivesUpAtOnce(Bringup):
    tries = 1


class TriesTwice(Bringup):
    tries = 2


class TriesForever(Bringup):
    async def try_to(self, name, label):
        while not await self.change(name, label):
            pass
        return True


class DoesNotWait(Bringup):
    async def change(self, name, label):
        self.managed[name].call_async(request_of(label))
        return True


class ForgetsTheAwait(Bringup):
    async def change(self, name, label):
        response = self.managed[name].call_async(request_of(label))
        return response.success


class AwaitsInTheDefaultGroup(Bringup):
    def make_group(self):
        return None


class CallsInACallback(Bringup):
    async def change(self, name, label):
        return self.managed[name].call(request_of(label)).success


class SpinsInACallback(AwaitsInTheDefaultGroup):
    async def change(self, name, label):
        future = self.managed[name].call_async(request_of(label))
        rclpy.spin_until_future_complete(self, future)
        return future.result().success


class WaitsInALoop(Bringup):
    async def change(self, name, label):
        future = self.managed[name].call_async(request_of(label))
        while not future.done():
            pass
        return future.result().success


class NodeByNode(Bringup):
    """Activates each as soon as it is configured, while the next one isn't even configured."""

    async def bring_up(self):
        for name in NODES:
            for label in ("configure", "activate"):
                if not await self.try_to(name, label):
                    self.get_logger().error(f"/{name}: {label} has failed three times")
                    await self.shut_down()
                    return


class FromTheBack(Bringup):
    async def bring_up(self):
        for label, name in [*reversed(PLAN[:3]), *reversed(PLAN[3:])]:
            if not await self.try_to(name, label):
                self.get_logger().error(f"/{name}: {label} has failed three times")
                await self.shut_down()
                return


class ActivatesTheControllerFirst(Bringup):
    async def bring_up(self):
        for label, name in [*PLAN[:3], *reversed(PLAN[3:])]:
            if not await self.try_to(name, label):
                self.get_logger().error(f"/{name}: {label} has failed three times")
                await self.shut_down()
                return


class ActivatesAllAtOnce(Bringup):
    async def bring_up(self):
        for name in NODES:
            if not await self.try_to(name, "configure"):
                self.get_logger().error(f"/{name} has failed three times")
                await self.shut_down()
                return
        for name in NODES:
            self.managed[name].call_async(request_of("activate"))


class SkipsWhatIsBroken(Bringup):
    async def bring_up(self):
        for label, name in PLAN:
            if not await self.try_to(name, label):
                self.get_logger().error(f"/{name}: {label} has failed three times")


class GivesUpSilently(Bringup):
    async def bring_up(self):
        for label, name in PLAN:
            if not await self.try_to(name, label):
                await self.shut_down()
                return


class GivesUpAndLeavesTheRest(Bringup):
    async def bring_up(self):
        for label, name in PLAN:
            if not await self.try_to(name, label):
                self.get_logger().error(f"/{name}: {label} has failed three times")
                return


class NeverActivates(Bringup):
    async def bring_up(self):
        for name in NODES:
            if not await self.try_to(name, "configure"):
                self.get_logger().error(f"/{name} has failed three times")
                await self.shut_down()
                return


class ShutsDownInOrder(Bringup):
    async def shut_down(self):
        for name in NODES:
            await self.change(name, "shutdown")


class ShutsDownAllAtOnce(Bringup):
    async def shut_down(self):
        for name in reversed(NODES):
            self.managed[name].call_async(request_of("shutdown"))


class OnlyDeactivates(Bringup):
    async def shut_down(self):
        for name in reversed(NODES):
            await self.change(name, "deactivate")


class ShutsDownTheControllerOnly(Bringup):
    async def shut_down(self):
        await self.change(NODES[-1], "shutdown")


class ForgetsTheSuccess(Bringup):
    async def on_shutdown(self, request, response):
        await self.shut_down()
        return response


class ShutsDownAtOnce(Bringup):
    """It doesn't wait until someone wants it."""

    async def bring_up(self):
        await super().bring_up()
        await self.shut_down()


class NoServiceForTheShutdown(Bringup):
    def create_service(self, *arguments, **more):
        if arguments[0] is not Trigger:
            return super().create_service(*arguments, **more)


class MisspeltTransition(Bringup):
    async def change(self, name, label):
        return await super().change(name, label.replace("configure", "configured"))


class MisspeltService(Bringup):
    def create_client(self, srv_type, srv_name, **more):
        return super().create_client(srv_type, srv_name.replace("change_state", "changestate"), **more)


class RequestsNothing(Bringup):
    async def bring_up(self):
        pass

    async def shut_down(self):
        pass


class StartsTwice(Bringup):
    """The timer isn't canceled."""

    async def start(self):
        await self.bring_up()
