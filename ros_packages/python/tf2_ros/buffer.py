"""The buffer that nodes use: it waits for transforms, and says when new ones came."""

import threading
from collections.abc import Callable
from time import sleep
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph
from tf2_py import BufferCore

from tf2_ros.buffer_interface import BufferInterface

AT_ONCE = Duration()
PAUSE = 0.02  # s, from one look to the next


class Buffer(BufferCore, BufferInterface):
    """Remembers the transforms that a TransformListener hears, for 10 s or cache_time."""

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        """node: offers the service tf2_frames there, and forgets all when this node's clock jumps back."""
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._waiting: list[Callable[[], None]] = []
        self._waiting_lock = threading.RLock()
        if node is not None:
            self.srv = node.create_service(FrameGraph, "tf2_frames", self._tell_frames)
        self.clock = node.get_clock() if node is not None else Clock()
        back = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
        self.jump_handle = self.clock.create_jump_callback(back, post_callback=self.time_jump_callback)

    def _tell_frames(self, request: FrameGraph.Request, response: FrameGraph.Response) -> FrameGraph.Response:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def time_jump_callback(self, time_jump: TimeJump) -> None:
        """Forget all: what was known belongs to another time."""
        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Remember where a moving frame is, and tell those who wait."""
        super().set_transform(transform, authority)
        self._tell_waiting()

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Remember where a frame is for all times, and tell those who wait."""
        super().set_transform_static(transform, authority)
        self._tell_waiting()

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = AT_ONCE,
    ) -> TransformStamped:
        """The transform that takes what is given in source_frame into target_frame.

        time: for which moment; Time() is the newest one that is known of the whole way.
        timeout: how long to wait for it. Without a second thread nothing new is heard meanwhile.

        Raises:
            TransformException: it can't be had; its kind and words tell why.
        """
        if timeout != AT_ONCE:  # else it would be looked up twice
            self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time
    ) -> TransformStamped:
        """The same, with await: it goes on when the transform has come."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = AT_ONCE,
    ) -> TransformStamped:
        """From source_frame at one time to target_frame at another, while fixed_frame stood still."""
        way = target_frame, target_time, source_frame, source_time, fixed_frame
        if timeout != AT_ONCE:
            self.can_transform_full(*way, timeout)
        return self.lookup_transform_full_core(*way)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> TransformStamped:
        """The same, with await."""
        way = target_frame, target_time, source_frame, source_time, fixed_frame
        await self.wait_for_transform_full_async(*way)
        return self.lookup_transform_full_core(*way)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = AT_ONCE,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Whether lookup_transform would find it within timeout; return_debug_tuple: and if not, why."""
        return _patient(
            lambda: self.can_transform_core(target_frame, source_frame, time), timeout, return_debug_tuple
        )

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = AT_ONCE,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Whether lookup_transform_full would find it within timeout."""
        way = target_frame, target_time, source_frame, source_time, fixed_frame
        return _patient(lambda: self.can_transform_full_core(*way), timeout, return_debug_tuple)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Time) -> Future:
        """A future that has the transform as its result, once it can be had."""
        way = target_frame, source_frame, time
        return self._future(lambda: self.can_transform_core(*way), lambda: self.lookup_transform_core(*way))

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Future:
        """The same for two moments."""
        way = target_frame, target_time, source_frame, source_time, fixed_frame
        return self._future(
            lambda: self.can_transform_full_core(*way), lambda: self.lookup_transform_full_core(*way)
        )

    def _future(self, can: Callable[[], tuple[bool, str]], look_up: Callable[[], Any]) -> Future:
        future = Future()

        def on_new_data() -> None:
            if not future.done() and can()[0]:
                future.set_result(look_up())

        on_new_data()
        if not future.done():
            with self._waiting_lock:
                self._waiting.append(on_new_data)
            future.add_done_callback(lambda _: self._forget(on_new_data))
        return future

    def _tell_waiting(self) -> None:
        with self._waiting_lock:
            for callback in list(self._waiting):
                callback()

    def _forget(self, callback: Callable[[], None]) -> None:
        with self._waiting_lock:
            self._waiting.remove(callback)


def _patient(
    can: Callable[[], tuple[bool, str]], timeout: Duration, with_reason: bool
) -> bool | tuple[bool, str]:
    """Ask until it can, or the time is over."""
    answer = can()
    if timeout != AT_ONCE:
        clock = Clock()
        end = clock.now() + timeout
        while not answer[0] and clock.now() < end:
            sleep(PAUSE)
            answer = can()
    return answer if with_reason else answer[0]
