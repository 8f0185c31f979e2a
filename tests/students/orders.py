"""Nodes that are right only by luck, and the same nodes done right."""

import queue
import threading
import time

import message_filters
import rclpy
from geometry_msgs.msg import PointStamped
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import Trigger


class TwoTopics(Node):
    """Publishes /a and /b at the same moments."""

    def __init__(self):
        super().__init__("two_topics")
        self.a = self.create_publisher(Float64, "/a", 10)
        self.b = self.create_publisher(Float64, "/b", 10)
        self.create_timer(0.1, self.send)

    def send(self):
        self.a.publish(Float64(data=1.0))
        self.b.publish(Float64(data=2.0))


class Pairs(Node):
    """Adds /b to the last /a, which it does not test."""

    def __init__(self):
        super().__init__("pairs")
        self.last = None
        self.sums = self.create_publisher(Float64, "/sum", 10)
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10)

    def on_a(self, msg):
        self.last = msg

    def on_b(self, msg):
        self.sums.publish(Float64(data=self.last.data + msg.data))


class PairsCarefully(Pairs):
    def on_b(self, msg):
        if self.last is None:
            return
        super().on_b(msg)


class PairsByName(Pairs):
    """Tests a local name, in a method that the callback calls."""

    def on_b(self, msg):
        self.add(msg)

    def add(self, msg):
        if (last := self.last) is not None:
            self.sums.publish(Float64(data=last.data + msg.data))


class StartsAtZero(Node):
    def __init__(self, name):
        super().__init__(name)
        self.last = Float64()


class PairsFromZero(StartsAtZero):
    """Sets the attribute in the __init__ of its base class."""

    def __init__(self):
        super().__init__("pairs")
        self.sums = self.create_publisher(Float64, "/sum", 10)
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10)

    def on_a(self, msg):
        self.last = msg

    def on_b(self, msg):
        self.sums.publish(Float64(data=self.last.data + msg.data))


class PairsWithoutInit(Node):
    """Reads an attribute that does not exist before the first /a."""

    def __init__(self):
        super().__init__("pairs")
        self.sums = self.create_publisher(Float64, "/sum", 10)
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10)

    def on_a(self, msg):
        self.offset = msg.data

    def on_b(self, msg):
        self.sums.publish(Float64(data=self.offset + msg.data))


class TwoTimers(Node):
    """One timer measures, and another with the same period publishes."""

    def __init__(self):
        super().__init__("two_timers")
        self.steps = 0
        self.sent = self.create_publisher(Float64, "/steps", 10)
        self.create_timer(0.1, self.step)
        self.create_timer(0.1, self.send)

    def step(self):
        self.steps += 1

    def send(self):
        self.sent.publish(Float64(data=float(self.steps)))


class OneTimer(TwoTimers):
    def __init__(self):
        Node.__init__(self, "one_timer")
        self.steps = 0
        self.sent = self.create_publisher(Float64, "/steps", 10)
        self.create_timer(0.1, self.step)

    def step(self):
        super().step()
        self.send()


class Stock(Node):
    """Sells what is left, and looks up the price meanwhile: two customers buy the last one."""

    def __init__(self):
        super().__init__("stock")
        self.left = 3
        self.group = ReentrantCallbackGroup()
        self.price = self.create_client(Trigger, "price")
        self.create_service(Trigger, "buy", self.buy, callback_group=self.group)

    async def buy(self, request, response):
        if self.left > 0:
            await self.price.call_async(Trigger.Request())
            self.left -= 1
            response.success = True
        return response


class ReservesStock(Stock):
    async def buy(self, request, response):
        if self.left > 0:
            self.left -= 1
            await self.price.call_async(Trigger.Request())
            response.success = True
        return response


class TestsStockAgain(Stock):
    async def buy(self, request, response):
        if self.left > 0:
            await self.price.call_async(Trigger.Request())
            if self.left > 0:
                self.left -= 1
                response.success = True
        return response


class Shop(Node):
    """Serves /price, after a while, and buys at two counters."""

    def __init__(self):
        super().__init__("shop")
        group = ReentrantCallbackGroup()
        self.create_service(Trigger, "price", self.price, callback_group=group)
        self.counters = [self.create_client(Trigger, "buy", callback_group=group) for _ in range(2)]
        self.create_timer(0.5, self.buy, callback_group=group)

    def price(self, request, response):
        time.sleep(0.1)
        response.success = True
        return response

    def buy(self):
        for counter in self.counters:
            counter.call_async(Trigger.Request())


class Counter(Node):
    """Counts messages of two topics, in callbacks of different groups."""

    def __init__(self):
        super().__init__("counter")
        self.count, self.lock = 0, threading.Lock()
        self.other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10, callback_group=self.other)

    def on_a(self, msg):
        self.count += 1

    def on_b(self, msg):
        count = self.count
        self.count = count + 1


class CountsUnderALock(Counter):
    def on_a(self, msg):
        with self.lock:
            super().on_a(msg)

    def on_b(self, msg):
        with self.lock:
            self.count += 1


class CountsInOneGroup(Counter):
    def __init__(self):
        Node.__init__(self, "counter")
        self.count = 0
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10)


class Works(Node):
    """A thread and a callback add to one sum."""

    def __init__(self):
        super().__init__("works")
        self.sum = 0.0
        self.create_subscription(Float64, "/a", self.on_a, 10)
        threading.Thread(target=self.work, daemon=True).start()

    def on_a(self, msg):
        self.sum += msg.data

    def work(self):
        while rclpy.ok():
            time.sleep(0.1)
            self.sum = self.sum / 2


class WorksAlone(Works):
    """The callback passes its messages on; the thread alone has the sum."""

    def __init__(self):
        self.waiting = queue.Queue()
        super().__init__()

    def on_a(self, msg):
        self.waiting.put(msg.data)

    def work(self):
        while rclpy.ok():
            self.sum += self.waiting.get()


class BothOrders(Node):
    """Takes two locks in both orders."""

    def __init__(self):
        super().__init__("both_orders")
        self.left, self.right = threading.Lock(), threading.Lock()
        self.other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Float64, "/a", self.on_a, 10)
        self.create_subscription(Float64, "/b", self.on_b, 10, callback_group=self.other)

    def on_a(self, msg):
        with self.left, self.right:
            self.get_logger().debug("a")

    def on_b(self, msg):
        with self.right:
            self.finish()

    def finish(self):
        with self.left:
            self.get_logger().debug("b")


class AcquiresInBothOrders(BothOrders):
    def on_a(self, msg):
        self.left.acquire()
        with self.right:
            self.get_logger().debug("a")
        self.left.release()


class OneOrder(BothOrders):
    def on_b(self, msg):
        with self.left, self.right:
            self.get_logger().debug("b")


class OneAfterTheOther(BothOrders):
    def on_b(self, msg):
        with self.right:
            self.get_logger().debug("b")
        self.finish()


class BothUnderAThird(BothOrders):
    def __init__(self):
        super().__init__()
        self.table = threading.Lock()

    def on_b(self, msg):
        with self.table, self.right:
            self.finish()

    def on_a(self, msg):
        with self.table, self.left, self.right:
            self.get_logger().debug("a")


class CountsReentrantly(Counter):
    """One callback, which may run in two threads at once."""

    def __init__(self):
        Node.__init__(self, "counter")
        self.count, group = 0, ReentrantCallbackGroup()
        self.create_subscription(Float64, "/a", self.on_a, 10, callback_group=group)


def with_threads(node_class):
    """A main() that spins a node of this class with two threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node_class())
        executor.spin()

    return main


count_with_threads = with_threads(Counter)
count_reentrantly = with_threads(CountsReentrantly)
count_under_a_lock = with_threads(CountsUnderALock)
count_in_one_group = with_threads(CountsInOneGroup)
lock_with_threads = with_threads(BothOrders)
acquire_with_threads = with_threads(AcquiresInBothOrders)
lock_in_one_order = with_threads(OneOrder)
lock_one_after_the_other = with_threads(OneAfterTheOther)
lock_under_a_third = with_threads(BothUnderAThird)


class TwoCameras(Node):
    """Publishes /left and /right of the same moments; /left has a longer way every third time."""

    def __init__(self):
        super().__init__("two_cameras")
        self.left = self.create_publisher(PointStamped, "/left", 10)
        self.right = self.create_publisher(PointStamped, "/right", 10)
        self.sent, self.late = 0, None
        self.create_timer(0.1, self.send)
        self.create_timer(0.02, self.send_late)

    def send(self):
        msg = PointStamped()
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.point.x = float(self.sent)
        self.sent += 1
        if self.sent % 3:
            self.left.publish(msg)
        else:
            self.late = msg
        self.right.publish(msg)

    def send_late(self):
        if self.late is not None and self.late.header.stamp != self.get_clock().now().to_msg():
            self.left.publish(self.late)
            self.late = None


class Disparity(Node):
    """Subtracts the last /left from /right, whenever that was."""

    def __init__(self):
        super().__init__("disparity")
        self.last = None
        self.found = self.create_publisher(Float64, "/disparity", 10)
        self.create_subscription(PointStamped, "/left", self.on_left, 10)
        self.create_subscription(PointStamped, "/right", self.on_right, 10)

    def on_left(self, msg):
        self.last = msg

    def on_right(self, msg):
        if self.last is not None:
            self.found.publish(Float64(data=msg.point.x - self.last.point.x))


class ComparesStamps(Disparity):
    def on_right(self, msg):
        if self.last is not None and self.last.header.stamp == msg.header.stamp:
            self.found.publish(Float64(data=msg.point.x - self.last.point.x))


class Synchronizes(Node):
    """Pairs by stamp."""

    def __init__(self):
        super().__init__("disparity")
        self.found = self.create_publisher(Float64, "/disparity", 10)
        subscribers = [message_filters.Subscriber(self, PointStamped, topic) for topic in ("/left", "/right")]
        self.pairs = message_filters.TimeSynchronizer(subscribers, 10)
        self.pairs.registerCallback(self.on_pair)

    def on_pair(self, left, right):
        self.found.publish(Float64(data=right.point.x - left.point.x))
