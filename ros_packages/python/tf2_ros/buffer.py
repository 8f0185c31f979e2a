"""The buffer that nodes use. It can wait for transforms."""

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

NO_TIMEOUT = Duration()
POLLING_PERIOD = 0.02  # s


class Buffer(BufferCore, BufferInterface):
    """Stores the transforms that a TransformListener receives, for 10 s or cache_time."""

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        """node: gets a service tf2_frames; if its clock jumps back, the buffer is cleared."""
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._callbacks: list[Callable[[], None]] = []
        self._callbacks_lock = threading.RLock()
        if node is not None:
            self.srv = node.create_service(FrameGraph, "tf2_frames", self._on_frames_request)
        self.clock = node.get_clock() if node is not None else Clock()
        backward = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
        self.jump_handle = self.clock.create_jump_callback(backward, post_callback=self.time_jump_callback)

    def _on_frames_request(
        self, request: FrameGraph.Request, response: FrameGraph.Response
    ) -> FrameGraph.Response:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def time_jump_callback(self, time_jump: TimeJump) -> None:
        """Clear the buffer, because its transforms belong to another time."""
        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Store a transform of a moving frame, and complete the futures that wait for it."""
        super().set_transform(transform, authority)
        self._call_callbacks()

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Store a transform that is valid at any time, and complete the futures that wait for it."""
        super().set_transform_static(transform, authority)
        self._call_callbacks()

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = NO_TIMEOUT,
    ) -> TransformStamped:
        """The transform that converts data in source_frame to target_frame.

        time: the time of the transform; Time() is the latest time at which it is available.
        timeout: how long to wait for it. Without a second thread, nothing is received in the meantime.

        Raises:
            TransformException: it is not available; the subclass and the message say why.
        """
        if timeout != NO_TIMEOUT:  # without a time-out, this would be a second lookup
            self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time
    ) -> TransformStamped:
        """Work like `lookup_transform`, but awaits the transform."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NO_TIMEOUT,
    ) -> TransformStamped:
        """The transform from source_frame at one time to target_frame at another, by way of fixed_frame."""
        query = target_frame, target_time, source_frame, source_time, fixed_frame
        if timeout != NO_TIMEOUT:
            self.can_transform_full(*query, timeout)
        return self.lookup_transform_full_core(*query)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> TransformStamped:
        """Work like `lookup_transform_full`, but awaits the transform."""
        query = target_frame, target_time, source_frame, source_time, fixed_frame
        await self.wait_for_transform_full_async(*query)
        return self.lookup_transform_full_core(*query)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = NO_TIMEOUT,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether lookup_transform would succeed in time. return_debug_tuple: also return why not."""
        return _poll(
            lambda: self.can_transform_core(target_frame, source_frame, time), timeout, return_debug_tuple
        )

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = NO_TIMEOUT,
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether lookup_transform_full would succeed within timeout."""
        query = target_frame, target_time, source_frame, source_time, fixed_frame
        return _poll(lambda: self.can_transform_full_core(*query), timeout, return_debug_tuple)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Time) -> Future:
        """A future that completes when the transform is available; its result is the transform."""
        query = target_frame, source_frame, time
        return self._future(
            lambda: self.can_transform_core(*query), lambda: self.lookup_transform_core(*query)
        )

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Future:
        """Work like `wait_for_transform_async`, for `lookup_transform_full`."""
        query = target_frame, target_time, source_frame, source_time, fixed_frame
        return self._future(
            lambda: self.can_transform_full_core(*query), lambda: self.lookup_transform_full_core(*query)
        )

    def _future(self, can_transform: Callable[[], tuple[bool, str]], lookup: Callable[[], Any]) -> Future:
        future = _ArrivalFuture()

        def on_new_data() -> None:
            if not future.done() and can_transform()[0]:
                future.set_result(lookup())

        on_new_data()
        if not future.done():
            with self._callbacks_lock:
                self._callbacks.append(on_new_data)
            future.add_done_callback(lambda _: self._remove_callback(on_new_data))
        return future

    def _call_callbacks(self) -> None:
        with self._callbacks_lock:
            for callback in list(self._callbacks):
                callback()

    def _remove_callback(self, callback: Callable[[], None]) -> None:
        with self._callbacks_lock:
            self._callbacks.remove(callback)


class _ArrivalFuture(Future):
    """A future that messages complete: to wait for it long is a wait for a message, and no mistake."""


def _poll(
    can_transform: Callable[[], tuple[bool, str]], timeout: Duration, with_reason: bool
) -> bool | tuple[bool, str]:
    """Call a function until it returns True or the time-out has passed."""
    answer = can_transform()
    if timeout != NO_TIMEOUT:
        clock = Clock()
        end = clock.now() + timeout
        while not answer[0] and clock.now() < end:
            sleep(POLLING_PERIOD)
            answer = can_transform()
    return answer if with_reason else answer[0]
