"""Tank robots that plan while they drive: right ones, and wrong ones named after their defect."""

import collections
import dataclasses
import math
import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from geometry_msgs.msg import Twist, Vector3
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Float64


def find_speed(radius, left, right):
    """Hard work: the speed (m/s) at which the robot doesn't tip over."""
    time.sleep(0.04)
    return math.sqrt(9.81 * 0.2 * radius * min(left, right) / (left + right))


def find_turn(radius, speed, left, right):
    """Hard work: the turn rate (rad/s), for a robot that pulls towards its heavier side."""
    time.sleep(0.04)
    return speed / radius * (1.0 + 0.1 * (right - left) / (left + right))


def command(speed, turn):
    """A Twist."""
    twist = Twist()
    twist.linear.x, twist.angular.z = speed, turn
    return twist


class Tanker(Node):
    """Nothing is wrong with it, a group for the planner and a short lock; the others change one thing each."""

    period, steps = 0.02, 3

    def __init__(self):
        super().__init__("tanker")
        self.lock = threading.Lock()
        self.left = self.right = 30.0
        self.speed = self.turn = 0.0
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.plans = self.create_publisher(Twist, "/plan", 10)
        fast, slow = self.groups()
        self.create_subscription(Vector3, "/load", self.on_load, 10, callback_group=fast)
        self.create_timer(self.period, self.drive, callback_group=fast)
        self.create_subscription(Float64, "/radius", self.on_radius, 10, callback_group=slow)

    def groups(self):
        return None, MutuallyExclusiveCallbackGroup()

    def on_load(self, msg):
        with self.lock:
            self.left = msg.x
            self.right = msg.y

    def drive(self):
        with self.lock:
            speed = self.speed
            turn = self.turn
        self.commands.publish(command(speed, turn))

    def on_radius(self, msg):
        for _ in range(self.steps):
            self.plan_once(msg.data)

    def plan_once(self, radius):
        with self.lock:
            left = self.left
            right = self.right
        speed = find_speed(radius, left, right)
        turn = find_turn(radius, speed, left, right)
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))

    def store(self, speed, turn):
        with self.lock:
            self.speed = speed
            self.turn = turn


def spun(*nodes, threads=2):
    """A main() that spins nodes of these classes with so many threads."""

    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(num_threads=threads)
        for node in nodes:
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


class AllReentrant(Tanker):
    """One reentrant group, and short locks."""

    def groups(self):
        return 2 * (ReentrantCallbackGroup(),)


class ThreeGroups(Tanker):
    """A group for each callback, and short locks."""

    def create_timer(self, period, callback, callback_group=None):
        return super().create_timer(period, callback, callback_group=MutuallyExclusiveCallbackGroup())


class Snapshots(Tanker):
    """No lock: what belongs together is one tuple, which is replaced at once."""

    def __init__(self):
        self.load, self.plan = (30.0, 30.0), (0.0, 0.0)
        super().__init__()

    def on_load(self, msg):
        self.load = (msg.x, msg.y)

    def drive(self):
        self.commands.publish(command(*self.plan))

    def plan_once(self, radius):
        left, right = self.load
        speed = find_speed(radius, left, right)
        plan = (speed, find_turn(radius, speed, left, right))
        self.plan = plan
        self.plans.publish(command(*plan))


class Messages(Tanker):
    """No lock: the newest messages are stored, and never changed."""

    def __init__(self):
        self.load, self.plan = Vector3(x=30.0, y=30.0), Twist()
        super().__init__()

    def on_load(self, msg):
        self.load = msg

    def drive(self):
        self.commands.publish(self.plan)

    def plan_once(self, radius):
        load = self.load
        plan = Twist()
        plan.linear.x = find_speed(radius, load.x, load.y)
        plan.angular.z = find_turn(radius, plan.linear.x, load.x, load.y)
        self.plan = plan
        self.plans.publish(plan)


@dataclasses.dataclass(frozen=True)
class TankState:
    """A load and a plan: one object that is never changed."""

    left: float = 30.0
    right: float = 30.0


class Frozen(Snapshots):
    """A frozen dataclass for the load."""

    def __init__(self):
        self.state = TankState()
        super().__init__()

    def on_load(self, msg):
        state = TankState(msg.x, msg.y)
        self.state = state
        self.load = (state.left, state.right)


class QueueToTheLoop(Tanker):
    """A design of its own: the planner puts its plan into a queue, and only the loop changes the plan."""

    def __init__(self):
        self.ready = queue.SimpleQueue()
        super().__init__()

    def drive(self):
        while not self.ready.empty():
            self.speed, self.turn = self.ready.get_nowait()
        self.commands.publish(command(self.speed, self.turn))

    def store(self, speed, turn):
        self.ready.put((speed, turn))


class SubscribesToItsPlan(Tanker):
    """A design of its own: the loop's group subscribes to /plan, and only it changes the plan."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Twist, "/plan", self.on_plan, 10)

    def on_plan(self, msg):
        self.speed, self.turn = msg.linear.x, msg.angular.z

    def store(self, speed, turn):
        pass


class WorkerThread(Tanker):
    """A design of its own: one thread of the executor, and a thread for the planner with a queue."""

    def __init__(self):
        self.orders = queue.Queue()
        super().__init__()
        threading.Thread(target=self.work, daemon=True).start()

    def groups(self):
        return None, None

    def on_radius(self, msg):
        self.orders.put(msg.data)

    def work(self):
        while True:
            radius = self.orders.get()
            for _ in range(self.steps):
                self.plan_once(radius)


class Pool(Tanker):
    """A design of its own: a pool does one step at a time; only the loop copies, stores and publishes."""

    def __init__(self):
        self.pool, self.step, self.left_to_do = ThreadPoolExecutor(1), None, collections.deque()
        super().__init__()

    def groups(self):
        return None, None

    def on_radius(self, msg):
        self.left_to_do.extend(self.steps * [msg.data])
        self.go_on()

    def go_on(self):
        if self.step is None and self.left_to_do:
            self.step = self.pool.submit(self.find, self.left_to_do.popleft(), self.left, self.right)

    def find(self, radius, left, right):
        speed = find_speed(radius, left, right)
        return speed, find_turn(radius, speed, left, right)

    def drive(self):
        if self.step is not None and self.step.done():
            self.speed, self.turn = self.step.result()
            self.step = None
            self.plans.publish(command(self.speed, self.turn))
            self.go_on()
        self.commands.publish(command(self.speed, self.turn))


class AwaitsTheSteps(Tanker):
    """A design of its own: a coroutine awaits each step, for which it starts a thread."""

    async def on_radius(self, msg):
        for _ in range(self.steps):
            done = Future(executor=self.executor)
            threading.Thread(target=self.work, args=(msg.data, done)).start()
            await done

    def work(self, radius, done):
        self.plan_once(radius)
        done.set_result(None)


class Planner(Node):
    """Half of a design of its own: a node that plans, and whose plans are received on /plan."""

    def __init__(self):
        super().__init__("planner")
        self.load = Vector3(x=30.0, y=30.0)
        self.plans = self.create_publisher(Twist, "/plan", 10)
        self.create_subscription(Vector3, "/load", self.on_load, 10)
        self.create_subscription(
            Float64, "/radius", self.on_radius, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_load(self, msg):
        self.load = msg

    def on_radius(self, msg):
        for _ in range(3):
            load = self.load
            speed = find_speed(msg.data, load.x, load.y)
            self.plans.publish(command(speed, find_turn(msg.data, speed, load.x, load.y)))


class Driver(Node):
    """The other half: it drives the newest plan."""

    def __init__(self):
        super().__init__("driver")
        self.plan = Twist()
        self.commands = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Twist, "/plan", self.on_plan, 10)
        self.create_timer(0.02, self.drive)

    def on_plan(self, msg):
        self.plan = msg

    def drive(self):
        self.commands.publish(self.plan)


right = spun(Tanker)
four_threads = spun(Tanker, threads=4)
all_reentrant = spun(AllReentrant, threads=4)
three_groups = spun(ThreeGroups, threads=3)
snapshots = spun(Snapshots)
messages = spun(Messages)
frozen = spun(Frozen)
queue_to_the_loop = spun(QueueToTheLoop)  # a design of its own
subscribes_to_its_plan = spun(SubscribesToItsPlan)  # a design of its own
worker_thread = spun_in_one_thread(WorkerThread)  # a design of its own
pool = spun_in_one_thread(Pool)  # a design of its own
awaits_the_steps = spun_in_one_thread(AwaitsTheSteps)  # a design of its own
two_nodes = spun(Planner, Driver)  # a design of its own


# -- wrong ones ----------------------------------------------------------------------------------


class OneGroup(Tanker):
    """The default group for all."""

    def groups(self):
        return None, None


class LocksEverything(Tanker):
    """One lock around every callback."""

    def __init__(self):
        self.everything = threading.Lock()
        super().__init__()

    def on_load(self, msg):
        with self.everything:
            super().on_load(msg)

    def drive(self):
        with self.everything:
            super().drive()

    def on_radius(self, msg):
        with self.everything:
            super().on_radius(msg)


class WorksWithTheLock(Tanker):
    """It holds the lock while it finds the speed."""

    def plan_once(self, radius):
        with self.lock:
            left = self.left
            right = self.right
            speed = find_speed(radius, left, right)
        turn = find_turn(radius, speed, left, right)
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))


class WaitsForThePlan(Tanker):
    """The loop doesn't publish while a plan is being made, so that none is half done."""

    planning = False

    def drive(self):
        if not self.planning:
            super().drive()

    def on_radius(self, msg):
        self.planning = True
        super().on_radius(msg)
        self.planning = False


class Unprotected(Tanker):
    """Two groups and no lock: it copies and stores in steps."""

    def on_load(self, msg):
        self.left = msg.x
        self.right = msg.y

    def drive(self):
        twist = Twist()
        twist.linear.x = self.speed
        twist.angular.z = self.turn
        self.commands.publish(twist)

    def plan_once(self, radius):
        left = self.left
        right = self.right
        speed = find_speed(radius, left, right)
        turn = find_turn(radius, speed, left, right)
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))

    def store(self, speed, turn):
        self.speed = speed
        self.turn = turn


class UnprotectedReentrant(Unprotected):
    """Everything at once, and no lock."""

    def groups(self):
        return 2 * (ReentrantCallbackGroup(),)


class LocksTheWriterOnly(Tanker):
    """A lock of which the reader knows nothing protects nothing."""

    def drive(self):
        twist = Twist()
        twist.linear.x = self.speed
        twist.angular.z = self.turn
        self.commands.publish(twist)


class SleepsToBeSafe(Unprotected):
    """It stores the plan a millisecond after a loop has run; that is luck."""

    def store(self, speed, turn):
        time.sleep(0.001)
        super().store(speed, turn)


class StoresAsItComputes(Tanker):
    def plan_once(self, radius):
        with self.lock:
            left, right = self.left, self.right
        self.speed = find_speed(radius, left, right)
        self.turn = find_turn(radius, self.speed, left, right)
        self.plans.publish(command(self.speed, self.turn))


class ChangesThePublishedObject(Messages):
    """It stores one message, and changes it in place."""

    def plan_once(self, radius):
        load = self.load
        self.plan.linear.x = find_speed(radius, load.x, load.y)
        self.plan.angular.z = find_turn(radius, self.plan.linear.x, load.x, load.y)
        self.plans.publish(self.plan)


class ReadsTheLoadAgain(Tanker):
    """It copies the load for the speed, and once more for the turn rate."""

    def plan_once(self, radius):
        speed = find_speed(radius, self.left, self.right)
        turn = find_turn(radius, speed, self.left, self.right)
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))


class Hurries(Tanker):
    """It doesn't work."""

    def plan_once(self, radius):
        share = min(self.left, self.right) / (self.left + self.right)
        speed = math.sqrt(9.81 * 0.2 * radius * share)
        turn = speed / radius * (1.0 + 0.1 * (self.right - self.left) / (self.left + self.right))
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))


class LeavesStepsOut(Tanker):
    """It plans twice, to have more time."""

    steps = 2


class CopiesTheLoadOnce(Tanker):
    """It plans all steps for the load of the beginning."""

    def on_radius(self, msg):
        with self.lock:
            left, right = self.left, self.right
        for _ in range(self.steps):
            speed = find_speed(msg.data, left, right)
            turn = find_turn(msg.data, speed, left, right)
            self.store(speed, turn)
            self.plans.publish(command(speed, turn))


class PlansLate(Tanker):
    """It sleeps between two steps, so that the loop has time."""

    def plan_once(self, radius):
        super().plan_once(radius)
        time.sleep(0.05)


class PlansOnly(Tanker):
    """It publishes plans, and doesn't drive them."""

    def store(self, speed, turn):
        pass


class SlowLoop(Tanker):
    period = 0.1


class DrivesLate(Tanker):
    """The loop looks for a new plan every 0.2 s."""

    def __init__(self):
        self.newest = 0.0, 0.0
        super().__init__()
        self.create_timer(0.2, self.look)

    def store(self, speed, turn):
        self.newest = speed, turn

    def look(self):
        self.speed, self.turn = self.newest


class SwapsTheFields(Tanker):
    def plan_once(self, radius):
        with self.lock:
            left, right = self.left, self.right
        speed = find_speed(radius, right, left)
        turn = find_turn(radius, speed, right, left)
        self.store(speed, turn)
        self.plans.publish(command(speed, turn))


class NeverDrives(Tanker):
    def drive(self):
        pass


one_group = spun(OneGroup)
one_thread = spun(Tanker, threads=1)
single_threaded = spun_in_one_thread(Tanker)
locks_everything = spun(LocksEverything)
works_with_the_lock = spun(WorksWithTheLock)
waits_for_the_plan = spun(WaitsForThePlan)
unprotected = spun(Unprotected)
unprotected_reentrant = spun(UnprotectedReentrant, threads=4)
locks_the_writer_only = spun(LocksTheWriterOnly)
sleeps_to_be_safe = spun(SleepsToBeSafe)
stores_as_it_computes = spun(StoresAsItComputes)
changes_the_published_object = spun(ChangesThePublishedObject)
reads_the_load_again = spun(ReadsTheLoadAgain)
hurries = spun(Hurries)
leaves_steps_out = spun(LeavesStepsOut)
copies_the_load_once = spun(CopiesTheLoadOnce)
plans_late = spun(PlansLate)
plans_only = spun(PlansOnly)
slow_loop = spun(SlowLoop)
drives_late = spun(DrivesLate)
swaps_the_fields = spun(SwapsTheFields)
never_drives = spun(NeverDrives)
PARTS = tuple(name for name, item in vars().items() if isinstance(item, type) or "spun" in name)
PARTS += ("command", "find_speed", "find_turn")
