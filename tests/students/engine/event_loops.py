"""Nodes beside asyncio's event loops."""

import asyncio
import threading
import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class Ticking(Node):
    """Ticks every 0.5 s."""

    def __init__(self, name="ticking"):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.say("tick")

    def say(self, text):
        self.get_logger().info(text)


class RunsInTimer(Ticking):
    """Each tick runs an event loop, for 0.2 s."""

    def tick(self):
        asyncio.run(asyncio.sleep(0.2))
        super().tick()


def gather_beside_a_spin_thread():
    """Coroutines, and a function in a thread that asyncio makes, while a thread spins."""
    rclpy.init()
    node = Ticking()
    threading.Thread(target=rclpy.spin, args=(node,)).start()

    async def count(name, seconds):
        for number in range(2):
            await asyncio.sleep(seconds)
            node.say(f"{name} {number}")
        return name

    async def work():
        sleep = asyncio.to_thread(time.sleep, 1)
        node.say(str(await asyncio.gather(count("a", 0.3), count("b", 0.4), sleep)))

    asyncio.run(work())


async def spin(node):
    """Let callbacks run between those of the event loop."""
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
        await asyncio.sleep(0.1)


def spins_in_a_coroutine():
    rclpy.init()
    asyncio.run(spin(Ticking()))


def awaits_an_action():
    """Awaits the futures of an action in an event loop that spins beside it, and ends the spinning."""
    rclpy.init()
    node = Node("client")
    client = ActionClient(node, Fibonacci, "fibonacci")
    client.wait_for_server()

    async def work():
        spinning = asyncio.create_task(spin(node))
        goal = await client.send_goal_async(Fibonacci.Goal(order=3))
        result = (await goal.get_result_async()).result
        spinning.cancel()
        node.get_logger().info(f"result {list(result.sequence)}")

    loop = asyncio.get_event_loop_policy().new_event_loop()
    loop.run_until_complete(work())
    loop.close()


def wakes_another_loop():
    """A callback wakes the coroutine that waits in another thread's event loop, and gets its answer."""
    rclpy.init()
    node, loop = Node("waker"), asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, daemon=True).start()

    async def answer():
        await asyncio.sleep(0.25)
        return asyncio.get_running_loop() is loop

    def tick():
        node.get_logger().info(str(asyncio.run_coroutine_threadsafe(answer(), loop).result()))

    node.create_timer(0.5, tick)
    rclpy.spin(node)


def own_loops():
    """Each program has its own event loop, also when it is not running."""
    rclpy.init()
    loop = asyncio.new_event_loop()
    asyncio.set_event_loop(loop)
    time.sleep(0.5)
    Node("own").get_logger().info(str(asyncio.get_event_loop_policy().get_event_loop() is loop))
    loop.run_until_complete(asyncio.sleep(0.5))
    loop.close()


def polls_without_waiting():
    """Gives way to others again and again, beside a spin thread."""
    rclpy.init()
    node = Ticking()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()

    async def poll():
        while True:
            await asyncio.sleep(0)

    asyncio.run(poll())


def waits_for_nothing():
    """An event that no one sets."""
    rclpy.init()
    node = Node("waiting")
    node.create_timer(0.5, lambda: asyncio.run(asyncio.Event().wait()))
    rclpy.spin(node)
