"""The library of the parcels' database, written for asyncio. It knows no shelf: it asks the database."""

import asyncio
import weakref

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.utilities import get_default_context
from std_msgs.msg import String

QUERIES, FOUND = "/database/query", "/database/found"
PAUSE = 0.02  # s between two looks


async def shelf_of(label: str) -> str:
    """Return the shelf of a parcel, such as "C7". The database takes about a second for its answer."""
    context = get_default_context()
    if context not in _connections:
        _connections[context] = _Connection(context)
    return await _connections[context].shelf_of(label)


class _Connection:
    """A node of its own, which a task of asyncio spins while a label is looked up."""

    def __init__(self, context: Context) -> None:
        node = Node("database_library", context=context, start_parameter_services=False, enable_rosout=False)
        self._queries = node.create_publisher(String, QUERIES, 100)
        node.create_subscription(String, FOUND, self._on_found, 100)
        self._context, self._executor = context, SingleThreadedExecutor(context=context)
        self._executor.add_node(node)
        self._unsent: list[str] = []
        self._shelves: dict[str, asyncio.Future[str]] = {}
        self._spinning: asyncio.Task[None] | None = None

    async def shelf_of(self, label: str) -> str:
        shelf = self._shelves[label] = asyncio.get_running_loop().create_future()
        self._unsent.append(label)
        if self._spinning is None or self._spinning.done():
            self._spinning = asyncio.create_task(self._spin())
        return str(await shelf)

    async def _spin(self) -> None:
        while self._shelves and self._context.ok():
            while self._unsent and self._queries.get_subscription_count():
                self._queries.publish(String(data=self._unsent.pop(0)))
            self._executor.spin_once(timeout_sec=0.0)
            await asyncio.sleep(PAUSE)

    def _on_found(self, found: String) -> None:
        label, _, text = found.data.rpartition(" ")
        shelf = self._shelves.pop(label, None)
        if shelf is not None and not shelf.done():
            shelf.set_result(text)


_connections: weakref.WeakKeyDictionary[Context, _Connection] = weakref.WeakKeyDictionary()
