"""Depots whose jobs must not wait for each other forever: right ones, and wrong ones named after their defect."""

import contextlib
import threading
import time

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String


class Depot(Node):
    """Nothing is wrong with it; the others change one thing each."""

    answers = {"corridor": "up", "lift": "down", "response": "load"}  # noqa: RUF012

    def __init__(self):
        super().__init__("depot")
        self.corridor, self.lift = threading.Lock(), threading.Lock()
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.dump = self.create_publisher(String, "/dump", latched)
        for what, callback in self.answers.items():
            self.dump.publish(String(data=f"{what}: {callback}"))
        self.places = self.create_publisher(String, "/places", 10)
        self.done = self.create_publisher(String, "/done", 10)
        self.groups = {name: self.group_of(name) for name in ("up", "down", "sweep", "load", "scale")}
        for name in ("up", "down", "sweep", "load"):
            self.create_subscription(
                Int32, f"/{name}", getattr(self, name), 10, callback_group=self.groups[name]
            )
        self.scale = self.create_client(AddTwoInts, "/scale", callback_group=self.groups["scale"])

    def group_of(self, name):
        return MutuallyExclusiveCallbackGroup()

    def drive(self, job, places):
        self.places.publish(String(data=f"{job} enters {places}"))
        time.sleep(0.15)
        self.places.publish(String(data=f"{job} leaves {places}"))

    def up(self, msg):
        with self.corridor:
            self.drive("up", "corridor")
            with self.lift:
                self.drive("up", "corridor lift")
        self.finish("up", msg)

    def down(self, msg):
        with self.corridor, self.lift:
            self.drive("down", "lift")
            self.drive("down", "corridor lift")
        self.finish("down", msg)

    def sweep(self, msg):
        with self.corridor:
            self.drive("sweep", "corridor")
            self.drive("sweep", "corridor")
        self.finish("sweep", msg)

    def load(self, msg):
        self.load_parcel(msg, self.scale.call(AddTwoInts.Request(a=msg.data)).sum)

    def load_parcel(self, msg, weight):
        with self.lift:
            self.drive("load", "lift")
        self.finish("load", msg, f" {weight}")

    def finish(self, job, msg, more=""):
        self.done.publish(String(data=f"{job} {msg.data}{more}"))


def spun(node, threads=5):
    """A main() that spins a node of this class with so many threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(num_threads=threads)
        executor.add_node(node())
        executor.spin()

    return main


def spun_in_one_thread(node):
    """A main() that spins a node with one thread."""

    def main():
        rclpy.init()
        rclpy.spin(node())

    return main


# -- right ones ----------------------------------------------------------------------------------


class LiftFirst(Depot):
    """The other order of the locks."""

    def up(self, msg):
        with self.lift, self.corridor:
            self.drive("up", "corridor")
            self.drive("up", "corridor lift")
        self.finish("up", msg)

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            with self.corridor:
                self.drive("down", "corridor lift")
        self.finish("down", msg)


class AllReentrant(Depot):
    """One reentrant group; the locks do the rest."""

    def __init__(self):
        self.one = ReentrantCallbackGroup()
        super().__init__()

    def group_of(self, name):
        return self.one


class DefaultGroupForTheClient(Depot):
    """The client is in the node's default group, in which nothing else is."""

    def group_of(self, name):
        return None if name == "scale" else super().group_of(name)


class DoneCallback(Depot):
    """No callback waits for the response: it is handled when it is there."""

    def group_of(self, name):
        return self.groups_of_load if name in ("load", "scale") else super().group_of(name)

    def __init__(self):
        self.groups_of_load = MutuallyExclusiveCallbackGroup()
        super().__init__()

    def load(self, msg):
        future = self.scale.call_async(AddTwoInts.Request(a=msg.data))
        future.add_done_callback(lambda done: self.load_parcel(msg, done.result().sum))


class WaitsForAnEvent(Depot):
    """It waits for the response with an event; the client has a group of its own."""

    def load(self, msg):
        arrived = threading.Event()
        future = self.scale.call_async(AddTwoInts.Request(a=msg.data))
        future.add_done_callback(lambda _: arrived.set())
        arrived.wait()
        self.load_parcel(msg, future.result().sum)


class Awaits(Depot):
    """A coroutine awaits the response; the client has a group of its own."""

    async def load(self, msg):
        response = await self.scale.call_async(AddTwoInts.Request(a=msg.data))
        self.load_parcel(msg, response.sum)


class SortedLocks(Depot):
    """A design of its own: a context takes any number of locks, always in the order of their names."""

    @contextlib.contextmanager
    def taken(self, *names):
        with contextlib.ExitStack() as stack:
            for name in sorted(names):
                stack.enter_context(getattr(self, name))
            yield

    def up(self, msg):
        with self.taken("lift", "corridor"):
            self.drive("up", "corridor")
            self.drive("up", "corridor lift")
        self.finish("up", msg)

    def down(self, msg):
        with self.taken("lift", "corridor"):
            self.drive("down", "lift")
            self.drive("down", "corridor lift")
        self.finish("down", msg)


class GroupForTheCorridor(Depot):
    """A design of its own: what uses the corridor is in one group, and only the lift has a lock."""

    def __init__(self):
        self.group_of_corridor = MutuallyExclusiveCallbackGroup()
        super().__init__()
        self.corridor = contextlib.nullcontext()

    def group_of(self, name):
        return self.group_of_corridor if name in ("up", "down", "sweep") else super().group_of(name)


class FreePlaces(Depot):
    """A design of its own: one condition guards the set of free places, and a job takes all that it needs at once."""

    def __init__(self):
        self.free, self.changed = {"corridor", "lift"}, threading.Condition()
        super().__init__()

    @contextlib.contextmanager
    def taken(self, *names):
        with self.changed:
            self.changed.wait_for(lambda: self.free >= set(names))
            self.free -= set(names)
        yield
        with self.changed:
            self.free |= set(names)
            self.changed.notify_all()

    def up(self, msg):
        with self.taken("corridor", "lift"):
            self.drive("up", "corridor")
            self.drive("up", "corridor lift")
        self.finish("up", msg)

    def down(self, msg):
        with self.taken("corridor", "lift"):
            self.drive("down", "lift")
            self.drive("down", "corridor lift")
        self.finish("down", msg)

    def sweep(self, msg):
        with self.taken("corridor"):
            self.drive("sweep", "corridor")
            self.drive("sweep", "corridor")
        self.finish("sweep", msg)

    def load_parcel(self, msg, weight):
        with self.taken("lift"):
            self.drive("load", "lift")
        self.finish("load", msg, f" {weight}")


class BacksOff(Depot):
    """A design of its own: a job that doesn't get its second lock gives back the first, and tries both again."""

    @contextlib.contextmanager
    def both(self):
        while True:
            self.lift.acquire()
            if self.corridor.acquire(blocking=False):
                break
            self.lift.release()
            time.sleep(0.01)
        try:
            yield
        finally:
            self.corridor.release()
            self.lift.release()

    def down(self, msg):
        with self.both():
            self.drive("down", "lift")
            self.drive("down", "corridor lift")
        self.finish("down", msg)


right = spun(Depot)
lift_first = spun(LiftFirst)
all_reentrant = spun(AllReentrant)
default_group_for_the_client = spun(DefaultGroupForTheClient)
done_callback = spun(DoneCallback)
waits_for_an_event = spun(WaitsForAnEvent)
awaits = spun(Awaits)
sorted_locks = spun(SortedLocks)  # a design of its own
group_for_the_corridor = spun(GroupForTheCorridor)  # a design of its own
free_places = spun(FreePlaces)  # a design of its own
backs_off = spun(BacksOff)  # a design of its own


# -- wrong ones ----------------------------------------------------------------------------------


class BothOrders(Depot):
    """The locks as in the program that hangs."""

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            with self.corridor:
                self.drive("down", "corridor lift")
        self.finish("down", msg)


class SameGroup(Depot):
    """The client as in the program that hangs."""

    def __init__(self):
        self.groups_of_load = MutuallyExclusiveCallbackGroup()
        super().__init__()

    def group_of(self, name):
        return self.groups_of_load if name in ("load", "scale") else super().group_of(name)


class SleepsFirst(BothOrders):
    """It lets the other one pass, and hopes."""

    def down(self, msg):
        time.sleep(0.2)
        super().down(msg)


class GoesOnAfterATimeout(BothOrders):
    """It waits for the second lock for a moment, and drives on without it."""

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            got_it = self.corridor.acquire(timeout=0.1)
            self.drive("down", "corridor lift")
            if got_it:
                self.corridor.release()
        self.finish("down", msg)


class GivesUpAfterATimeout(BothOrders):
    """It waits for the second lock for a moment, and then leaves the job."""

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            if not self.corridor.acquire(timeout=0.1):
                return
            self.drive("down", "corridor lift")
            self.corridor.release()
        self.finish("down", msg)


class DoesNotWaitForTheScale(SameGroup):
    """It waits for the response for a moment, and then goes on without a weight."""

    def load(self, msg):
        future = self.scale.call_async(AddTwoInts.Request(a=msg.data))
        time.sleep(0.2)
        self.load_parcel(msg, future.result().sum if future.done() else 0)


class NoLocks(Depot):
    def __init__(self):
        super().__init__()
        self.corridor = self.lift = contextlib.nullcontext()


class OneLock(Depot):
    """One lock for both places."""

    def __init__(self):
        super().__init__()
        self.corridor = self.lift = threading.RLock()


class OneGroup(Depot):
    """One group for all jobs, and one for the client."""

    def __init__(self):
        self.group_of_jobs = MutuallyExclusiveCallbackGroup()
        super().__init__()

    def group_of(self, name):
        return super().group_of(name) if name == "scale" else self.group_of_jobs


class SaysDoneAtOnce(Depot):
    """It drives nowhere."""

    def drive(self, job, places):
        pass


class DrivesThroughTheLiftOnly(Depot):
    """It leaves the corridor out, so that it needs one lock."""

    def down(self, msg):
        with self.lift:
            self.drive("down", "lift")
            self.drive("down", "lift")
        self.finish("down", msg)


class FinishesTwice(Depot):
    def finish(self, job, msg, more=""):
        super().finish(job, msg, more)
        super().finish(job, msg, more)


class ReadsTheLinesAsHeld(Depot):
    """It takes what a thread waits for as what it holds."""

    answers = {"corridor": "down", "lift": "up", "response": "load"}  # noqa: RUF012


class BlamesTheSweeper(Depot):
    """The sweeper waits, and holds nothing."""

    answers = {"corridor": "sweep", "lift": "down", "response": "main"}  # noqa: RUF012


class SaysNothingOfTheDump(Depot):
    answers = {}  # noqa: RUF012


both_orders = spun(BothOrders)
same_group = spun(SameGroup)
two_threads = spun(Depot, threads=2)
sleeps_first = spun(SleepsFirst)
goes_on_after_a_timeout = spun(GoesOnAfterATimeout)
gives_up_after_a_timeout = spun(GivesUpAfterATimeout)
does_not_wait_for_the_scale = spun(DoesNotWaitForTheScale)
no_locks = spun(NoLocks)
one_lock = spun(OneLock)
one_group = spun(OneGroup)
one_thread = spun_in_one_thread(DoneCallback)
one_thread_that_calls = spun_in_one_thread(Depot)
says_done_at_once = spun(SaysDoneAtOnce)
drives_through_the_lift_only = spun(DrivesThroughTheLiftOnly)
finishes_twice = spun(FinishesTwice)
reads_the_lines_as_held = spun(ReadsTheLinesAsHeld)
blames_the_sweeper = spun(BlamesTheSweeper)
says_nothing_of_the_dump = spun(SaysNothingOfTheDump)
PARTS = tuple(name for name, item in vars().items() if isinstance(item, type) or "spun" in name)
