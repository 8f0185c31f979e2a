"""A callback is added to a result that has just arrived, and never called (as in rclpy#564)."""

import threading
import time

from rclpy.node import Node
from std_srvs.srv import Trigger


class Result:
    """A result, and who waits for it."""

    def __init__(self):
        self.value, self.callbacks = None, []
        self.lock = threading.Lock()

    def set(self, value):
        self.value = value
        for callback in self.callbacks:
            callback()

    def when_set(self, callback):
        if self.value is None:
            self.callbacks.append(callback)
        else:
            callback()


class LockedResult(Result):
    """Looks and adds under one lock."""

    def set(self, value):
        with self.lock:
            super().set(value)

    def when_set(self, callback):
        with self.lock:
            super().when_set(callback)


class Caller(Node):
    """A thread calls a service, and waits for each result."""

    result = Result

    def __init__(self):
        super().__init__("caller")
        self.client = self.create_client(Trigger, "trigger")
        self.calls = 0
        threading.Thread(target=self.work, daemon=True).start()
        self.create_timer(3.0, self.look)

    def work(self):
        while not self.client.service_is_ready():
            time.sleep(0.1)
        for _ in range(3):
            self.call()
            self.calls += 1

    def call(self):
        result, arrived = self.result(), threading.Event()
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda future: result.set(future.result()))
        result.when_set(arrived.set)
        arrived.wait()

    def look(self):
        assert self.calls == 3, f"{self.calls} of 3 calls"


class LockedCaller(Caller):
    """The same with the other results."""

    result = LockedResult


class Server(Node):
    """Answers."""

    def __init__(self):
        super().__init__("server")
        self.create_service(Trigger, "trigger", lambda request, response: response)


WRONG, RIGHT = (Caller, Server), (LockedCaller, Server)
