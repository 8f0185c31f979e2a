"""Nodes that wait for a database with asyncio: right ones, and wrong ones named by their defect."""

import asyncio
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty, String

from grader.exercises.warehouse import shelf_of

PARTS = ("Shelves", "spinning", "in_event_loop", "AwaitsInTheCallback", "ForgetsAwait", "NewestLabel",
         "CancelsTheLast", "OtherTopic", "NoLabels")  # fmt: skip


class Shelves(Node):
    """As one would write it; the others change one thing each."""

    shelf_topic = "/shelf"

    def __init__(self):
        super().__init__("shelves")
        self.tasks = set()
        self.alive_pub = self.create_publisher(Empty, "/alive", 10)
        self.shelf_pub = self.create_publisher(String, self.shelf_topic, 10)
        self.create_timer(0.1, lambda: self.alive_pub.publish(Empty()))
        self.create_subscription(String, "/label", self.on_label, 10)

    def on_label(self, message):
        self.start(self.answer(message.data))

    def start(self, coroutine):
        task = asyncio.create_task(coroutine)
        self.tasks.add(task)
        task.add_done_callback(self.tasks.discard)

    async def answer(self, label):
        self.publish(label, await shelf_of(label))

    def publish(self, label, shelf):
        self.shelf_pub.publish(String(data=f"{label}: {shelf}"))


async def spinning(node, pause=0.02):
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.0)
        await asyncio.sleep(pause)


def in_event_loop(node_class, pause=0.02):
    """A program in which asyncio drives rclpy."""

    def main():
        rclpy.init()
        asyncio.run(spinning(node_class(), pause))

    return main


as_in_the_lesson = in_event_loop(Shelves)


def queues():
    """A queue, from which a coroutine takes each label and starts a task."""
    rclpy.init()
    node, executor = Shelves(), SingleThreadedExecutor()
    executor.add_node(node)

    async def taking(queue):
        async with asyncio.TaskGroup() as group:
            while True:
                group.create_task(node.answer(await queue.get()))

    async def whole():
        queue = asyncio.Queue()
        node.on_label = lambda message: queue.put_nowait(message.data)
        node.create_subscription(String, "/label", node.on_label, 10)
        taker = asyncio.create_task(taking(queue))
        while rclpy.ok():
            executor.spin_once(timeout_sec=0.01)
            await asyncio.sleep(0.01)
        taker.cancel()

    node.destroy_subscription(next(node.subscriptions))
    asyncio.run(whole())


class InAnotherLoop(Shelves):
    """The event loop has a thread of its own, and rclpy.spin() the main one."""

    def __init__(self):
        super().__init__()
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()

    def start(self, coroutine):
        asyncio.run_coroutine_threadsafe(coroutine, self.loop)


class StepsTheLoop(Shelves):
    """A design of its own: rclpy drives asyncio, a step of the event loop in each call of a timer."""

    def __init__(self):
        super().__init__()
        self.loop = asyncio.new_event_loop()
        self.create_timer(0.02, self.step)

    def step(self):
        self.loop.call_soon(self.loop.stop)
        self.loop.run_forever()

    def start(self, coroutine):
        self.loop.create_task(coroutine)


def spun_in_a_thread():
    """rclpy.spin() has a thread of its own, and wakes the event loop."""
    rclpy.init()
    node = Shelves()

    async def whole():
        loop = asyncio.get_running_loop()
        node.start = lambda coroutine: asyncio.run_coroutine_threadsafe(coroutine, loop)
        await asyncio.to_thread(rclpy.spin, node)

    asyncio.run(whole())


class AwaitsInTheCallback(Shelves):
    """asyncio's future is not rclpy's."""

    async def on_label(self, message):
        await self.answer(message.data)


awaits_in_the_callback = in_event_loop(AwaitsInTheCallback)


class RunsInTheCallback(Shelves):
    """Each callback waits for its answer, and the node with it."""

    def start(self, coroutine):
        asyncio.run(coroutine)


def one_after_the_other():
    """A single coroutine answers all labels."""
    rclpy.init()
    node = Shelves()

    async def whole():
        queue = asyncio.Queue()
        node.start = queue.put_nowait
        await asyncio.gather(spinning(node), answering(queue))

    async def answering(queue):
        while True:
            await (await queue.get())

    asyncio.run(whole())


def spins_forever():
    """No task gets its turn."""

    async def spin(node):
        rclpy.spin(node)

    rclpy.init()
    asyncio.run(spin(Shelves()))


def sleeps_with_time():
    """As spins_forever: nothing in the loop is awaited."""

    async def spin(node):
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=0.0)
            time.sleep(0.02)

    rclpy.init()
    asyncio.run(spin(Shelves()))


sleeps_long = in_event_loop(Shelves, pause=0.4)


busy_loop = in_event_loop(Shelves, pause=0)
runs_in_the_callback = in_event_loop(RunsInTheCallback)


class ForgetsAwait(Shelves):
    async def answer(self, label):
        self.publish(label, shelf_of(label))


forgets_await = in_event_loop(ForgetsAwait)


class NewestLabel(Shelves):
    """Several coroutines share one attribute."""

    def on_label(self, message):
        self.label = message.data
        super().on_label(message)

    async def answer(self, label):
        shelf = await shelf_of(label)
        self.publish(self.label, shelf)


newest_label = in_event_loop(NewestLabel)


class CancelsTheLast(Shelves):
    """Only the newest label of a burst gets an answer."""

    def start(self, coroutine):
        for task in self.tasks:
            task.cancel()
        super().start(coroutine)


cancels_the_last = in_event_loop(CancelsTheLast)


class OtherTopic(Shelves):
    """A name that no other program knows."""

    shelf_topic = "/shelves"


other_topic = in_event_loop(OtherTopic)


class NoLabels(Shelves):
    def create_subscription(self, *about):
        return None


no_labels = in_event_loop(NoLabels)
