"""Nodes that let someone else add: right ones, and wrong ones named by their defect."""

import time
from functools import partial

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, Int64

PARTS = ("Odometer",)


class Odometer(Node):
    """All but the question itself."""

    group, whole = None, True  # of client and timer, or of the client alone
    service, topic, period = "/add_two_ints", "/ticks/total", 1.0

    def __init__(self):
        super().__init__("odometer")
        self.left = self.right = 0
        self.publisher = self.create_publisher(Int64, self.topic, 10)
        self.heart = self.create_publisher(Bool, "/heartbeat", 10)
        self.create_subscription(Int64, "/ticks/left", partial(self.count, "left"), 10)
        self.create_subscription(Int64, "/ticks/right", partial(self.count, "right"), 10)
        self.create_timer(0.1, lambda: self.heart.publish(Bool(data=True)))
        group = self.group() if self.group else None
        self.client = self.create_client(AddTwoInts, self.service, callback_group=group)
        self.create_timer(self.period, self.look, callback_group=group if self.whole else None)

    def count(self, side, msg):
        setattr(self, side, msg.data)

    def question(self):
        return AddTwoInts.Request(a=self.left, b=self.right)

    def say(self, answer):
        self.publisher.publish(Int64(data=answer.sum))


class Awaiting(Odometer):
    """A coroutine; timer and client have a group of their own."""

    group = ReentrantCallbackGroup

    async def look(self):
        self.say(await self.client.call_async(self.question()))


class WithDoneCallback(Odometer):
    def look(self):
        self.client.call_async(self.question()).add_done_callback(lambda future: self.say(future.result()))


class LooksLater(Odometer):
    """A design of its own: keeps the future, and looks at it with each beat."""

    def __init__(self):
        super().__init__()
        self.futures = []
        self.create_timer(0.05, self.collect)

    def look(self):
        self.futures.append(self.client.call_async(self.question()))

    def collect(self):
        for future in [f for f in self.futures if f.done()]:
            self.futures.remove(future)
            self.say(future.result())


class BlockingWithoutThreads(Odometer):
    """The group alone is not enough: there is one thread, and it waits."""

    group = ReentrantCallbackGroup

    def look(self):
        self.say(self.client.call(self.question()))


def main_with_threads(args=None):
    rclpy.init(args=args)
    node = BlockingWithoutThreads()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    try:
        executor.spin()
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def main_that_asks_beside_spin(args=None):
    """No class: the main function asks, and spins in between."""
    rclpy.init(args=args)
    node = Node("odometer")
    ticks = {"left": 0, "right": 0}
    total = node.create_publisher(Int64, "ticks/total", 10)
    heart = node.create_publisher(Bool, "heartbeat", 10)
    for side in ticks:
        node.create_subscription(
            Int64, f"ticks/{side}", lambda msg, side=side: ticks.update({side: msg.data}), 10
        )
    node.create_timer(0.1, lambda: heart.publish(Bool(data=True)))
    client = node.create_client(AddTwoInts, "add_two_ints")
    begin = node.get_clock().now().nanoseconds / 1e9 + 1.0
    while rclpy.ok():
        while node.get_clock().now().nanoseconds / 1e9 < begin:
            rclpy.spin_once(node)
        future = client.call_async(AddTwoInts.Request(a=ticks["left"], b=ticks["right"]))
        rclpy.spin_until_future_complete(node, future)
        total.publish(Int64(data=future.result().sum))
        begin += 1.0


class Frozen(Odometer):
    """The node of the task."""

    def look(self):
        self.say(self.client.call(self.question()))


class AwaitingWhileTheHeartStops(Awaiting):
    """Only the client has a group of its own. The timer's group, and the heart in it, waits for look."""

    group, whole = MutuallyExclusiveCallbackGroup, False


class SpinsInTheCallback(Odometer):
    def look(self):
        future = self.client.call_async(self.question())
        rclpy.spin_until_future_complete(self, future)
        self.say(future.result())


class AwaitingInOneGroup(Odometer):
    async def look(self):
        self.say(await self.client.call_async(self.question()))


class AwaitingWithoutAsync(Odometer):
    """Forgets both words: what comes is the future, not the answer."""

    def look(self):
        self.say(self.client.call_async(self.question()))


class SleepsForTheAnswer(Odometer):
    def look(self):
        future = self.client.call_async(self.question())
        time.sleep(0.5)
        self.say(future.result())


class LoopsForTheAnswer(Odometer):
    def look(self):
        future = self.client.call_async(self.question())
        while not future.done():
            pass
        self.say(future.result())


class AddsByItself(Odometer):
    def look(self):
        self.say(AddTwoInts.Response(sum=self.left + self.right))


class OldTicks(Odometer):
    """The request is made once."""

    def __init__(self):
        super().__init__()
        self.request = self.question()

    def look(self):
        future = self.client.call_async(self.request)
        future.add_done_callback(lambda future: self.say(future.result()))


class PublishesItsOwnSum(Odometer):
    """With the ticks of now, while the answer is about those of then."""

    def look(self):
        future = self.client.call_async(self.question())
        future.add_done_callback(lambda future: self.say(AddTwoInts.Response(sum=self.left + self.right)))


class ForgetsToPublish(Odometer):
    def look(self):
        future = self.client.call_async(self.question())
        future.add_done_callback(lambda future: future.result())


class SleepsInTheDoneCallback(Odometer):
    def look(self):
        future = self.client.call_async(self.question())
        future.add_done_callback(self.on_response)

    def on_response(self, future):
        self.say(future.result())
        time.sleep(0.4)


class MisspeltService(WithDoneCallback):
    service = "/add_too_ints"


class MisspeltTopic(WithDoneCallback):
    topic = "/tick/total"


class PublishesTheWholeAnswer(Awaiting):
    def say(self, answer):
        self.publisher.publish(answer)


class AsksByPosition(Awaiting):
    def question(self):
        return AddTwoInts.Request(self.left, self.right)


def main_that_logs_that_it_waits(args=None):
    """Right, too: it waits for the service with a time limit, before anything runs, and logs that it does."""
    rclpy.init(args=args)
    node = WithDoneCallback()
    while not node.client.wait_for_service(timeout_sec=1.0):
        node.get_logger().info("Waiting for /add_two_ints")
    rclpy.spin(node)


class PublishesEverySum(WithDoneCallback):
    """Whatever the sum may be: the right one is among them."""

    def say(self, answer):
        for sum_ in range(answer.sum - 2, answer.sum + 3):
            self.publisher.publish(Int64(data=sum_))
