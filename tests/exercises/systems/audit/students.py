"""Answers about six systems: right ones, and wrong ones named after their defect."""

import functools
import threading
import time

from rclpy.node import Node
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger

from grader.exercises.systems import Collector, Dock, JobStarter, Labeler, Rider, SpeedGate, audited
from tests.students.teams import Team

# -- repairs -------------------------------------------------------------------------------------


class RepairedLabeler(Labeler):
    """Everything is stored under the number of its parcel."""

    def store(self, kind, parcel, value):
        seen = self.seen.setdefault(parcel, {})
        seen[kind] = value
        if len(seen) == 2:
            self.labels.publish(String(data=f"{parcel} {seen['color']} {seen['weight']}"))
            del self.seen[parcel]


class RepairedDock(Dock):
    """The dock is taken before the gate is called."""

    def take_next(self):
        if self.robot is None and self.waiting:
            robot = self.robot = self.waiting.pop(0)
            future = self.gate.call_async(Trigger.Request())
            future.add_done_callback(lambda _: self.admit(robot))


class RepairedCollector(Collector):
    """Each callback looks whether the path is complete."""

    def on_point(self, msg):
        self.points.append(msg.data)
        self.send()

    def send(self):
        if self.count is None or len(self.points) < self.count:
            return
        self.paths.publish(String(data=" ".join(self.points[: self.count])))
        self.points, self.count = self.points[self.count :], None


class RepairedRider(Rider):
    """Doors that opened since the ride began are remembered."""

    def on_ride(self, msg):
        self.open = set()
        super().on_ride(msg)

    def on_called(self, future):
        self.lift = future.result().message
        if self.lift in self.open:
            self.on_doors(String(data=self.lift))

    def on_doors(self, msg):
        if self.lift is None:
            self.open.add(msg.data)
        super().on_doors(msg)


class RememberedDoors(Rider):
    """It is complete before its subscriptions exist."""

    def __init__(self):
        self.open = set()
        super().__init__()

    def on_ride(self, msg):
        self.open = set()
        super().on_ride(msg)

    def on_called(self, future):
        self.lift = future.result().message
        if self.lift in self.open:
            self.on_doors(String(data=self.lift))

    def on_doors(self, msg):
        self.open.add(msg.data)
        super().on_doors(msg)


class CopiedDock(Node):
    """A whole copy of the class, with one more variable in it."""

    def __init__(self):
        super().__init__("dock")
        self.opening = False
        self.robot, self.waiting = None, []  # the one in the dock; those that have arrived
        self.admitted = self.create_publisher(String, "admitted", 10)
        self.gate = self.create_client(Trigger, "open_gate")
        self.create_subscription(String, "arrivals", self.on_arrival, 10)
        self.create_subscription(String, "departures", self.on_departure, 10)

    def on_arrival(self, msg):
        self.waiting.append(msg.data)
        self.take_next()

    def on_departure(self, msg):
        self.robot = None
        self.take_next()

    def take_next(self):
        if self.robot is None and self.waiting and not self.opening:
            self.opening = True
            robot = self.waiting.pop(0)
            future = self.gate.call_async(Trigger.Request())
            future.add_done_callback(lambda _: self.admit(robot))

    def admit(self, robot):
        self.opening = False
        self.robot = robot
        self.admitted.publish(String(data=robot))


class TwoTables(Labeler):
    """A design of its own: a table for each kind, and the parcel is looked up in both."""

    def store(self, kind, parcel, value):
        self.seen[kind, parcel] = value
        color, weight = self.seen.get(("color", parcel)), self.seen.get(("weight", parcel))
        if color and weight:
            self.labels.publish(String(data=f"{parcel} {color} {weight}"))
            self.seen = {key: each for key, each in self.seen.items() if key[1] != parcel}


class AdmitsLater(Dock):
    """A design of its own: it opens the gate for each robot, and asks again when it's open."""

    def admit(self, robot):
        if self.robot is None:
            super().admit(robot)
        else:
            self.waiting.insert(0, robot)


class LooksOften(Collector):
    """A design of its own: a timer looks whether the path is complete."""

    def __init__(self):
        super().__init__()
        self.create_timer(0.02, self.send)

    def send(self):
        if self.count is not None and len(self.points) >= self.count:
            super().send()


class AwaitsTheDoors(Rider):
    """A design of its own: it looks at all doors since the ride began whenever it learns something."""

    def on_ride(self, msg):
        self.doors = []
        super().on_ride(msg)

    def on_called(self, future):
        super().on_called(future)
        for lift in self.doors:
            super().on_doors(String(data=lift))

    def on_doors(self, msg):
        self.doors.append(msg.data)
        super().on_doors(msg)


# -- right ones ----------------------------------------------------------------------------------

LABELER = {"camera": 0.2}, RepairedLabeler
DOCK = {"open_gate": 0.15}, RepairedDock
COLLECTOR = {"points": 0.15}, RepairedCollector
RIDER = {"call_lift": 0.25}, RepairedRider


RIGHT_ONES = {"labeler": LABELER, "dock": DOCK, "collector": COLLECTOR, "rider": RIDER, "job_starter": None,
              "speed_gate": None}  # fmt: skip


def handed_in(**changes):
    """The right answers, some of them changed."""
    return Team(*audited(lambda: RIGHT_ONES | changes))


right = handed_in()
the_longest_delays = handed_in(
    labeler=({"camera": 0.3}, RepairedLabeler), dock=({"open_gate": 0.3}, RepairedDock),
    collector=({"points": 0.3}, RepairedCollector), rider=({"call_lift": 0.3}, RepairedRider),
)  # fmt: skip
one_message_late = handed_in(
    labeler=({"/scale": [0, 0.25]}, RepairedLabeler), dock=({"arrivals": [0.15, 0]}, RepairedDock),
    collector=({"points": [0, 0, 0.15]}, RepairedCollector), rider=({"call_lift": [0.25]}, RepairedRider),
)  # fmt: skip
copies_a_class = handed_in(dock=(DOCK[0], CopiedDock))
complete_before_it_subscribes = handed_in(rider=(RIDER[0], RememberedDoors))
two_tables = handed_in(labeler=(LABELER[0], TwoTables))  # a design of its own
admits_later = handed_in(dock=(DOCK[0], AdmitsLater))  # a design of its own
looks_often = handed_in(collector=(COLLECTOR[0], LooksOften))  # a design of its own
all_doors = handed_in(rider=(RIDER[0], AwaitsTheDoors))  # a design of its own


# -- wrong ones ----------------------------------------------------------------------------------


class DeepQueues(Labeler):
    """More room in the queues changes no order."""

    def create_subscription(self, type_, topic, callback, depth):
        return super().create_subscription(type_, topic, callback, 1000)


class Locks(Dock):
    """One lock around each callback: it's free again before the gate is open."""

    lock = threading.Lock()

    def on_arrival(self, msg):
        with self.lock:
            super().on_arrival(msg)

    def admit(self, robot):
        with self.lock:
            super().admit(robot)


class Sleeps(Collector):
    """It waits for the points in the callback, and keeps them from arriving."""

    def on_size(self, msg):
        time.sleep(0.09)
        super().on_size(msg)


class SwallowsErrors(Rider):
    """It has no lift yet, and ignores that."""

    def on_doors(self, msg):
        try:
            assert self.lift is not None
            super().on_doors(msg)
        except AssertionError:
            pass


class TurnsAway(RepairedDock):
    """A robot that comes while the dock is taken is forgotten."""

    def on_arrival(self, msg):
        if self.robot is None:
            super().on_arrival(msg)


class DropsIncomplete(Collector):
    """A path whose points aren't all there is never published."""

    def send(self):
        if len(self.points) >= self.count:
            super().send()


class WaitsHalfASecond(Collector):
    """By then all points are there, and the path is late."""

    def on_size(self, msg):
        timer = self.create_timer(0.5, lambda: (timer.cancel(), super(WaitsHalfASecond, self).on_size(msg)))


class RemembersOldDoors(Rider):
    """Doors that opened for an earlier ride count as well."""

    def __init__(self):
        self.open = set()
        super().__init__()

    def on_called(self, future):
        self.lift = future.result().message
        if self.lift in self.open:
            self.on_doors(String(data=self.lift))

    def on_doors(self, msg):
        self.open.add(msg.data)
        super().on_doors(msg)


class RemembersTheLastDoors(Rider):
    """Another lift's doors may open after those of the right one."""

    def on_ride(self, msg):
        self.last = None
        super().on_ride(msg)

    def on_called(self, future):
        super().on_called(future)
        if self.last is not None:
            self.on_doors(self.last)

    def on_doors(self, msg):
        self.last = msg
        super().on_doors(msg)


class WrittenAnew(Labeler):
    """Right, and nothing is left of the given class."""

    def on_scale(self, msg):
        parcel, weight = msg.data.split()
        self.weights = {**getattr(self, "weights", {}), parcel: weight}
        self.publish_label(parcel)

    def on_camera(self, msg):
        parcel, color = msg.data.split()
        self.colors = {**getattr(self, "colors", {}), parcel: color}
        self.publish_label(parcel)

    def publish_label(self, parcel):
        weight = getattr(self, "weights", {}).get(parcel)
        color = getattr(self, "colors", {}).get(parcel)
        if weight is not None and color is not None:
            self.labels.publish(String(data=f"{parcel} {color} {weight}"))


class FromNowhere(Labeler):
    """Its method is an object without a source."""

    store = functools.partialmethod(RepairedLabeler.store)


class Guesses(Node):
    """It publishes numbers in place of answers."""

    def __init__(self):
        super().__init__("auditor")
        publisher = self.create_publisher(String, "/audit/answers", 10)
        self.create_subscription(Int32, "/audit/question", lambda msg: publisher.publish(String(data="4 of 6")), 10)


class Meddler(Node):
    """It publishes to the given systems, so that they break their promises."""

    def __init__(self):
        super().__init__("meddler")
        publisher = self.create_publisher(String, "/given/camera", 10)
        self.create_timer(0.1, lambda: publisher.publish(String(data="103")))


EACH = {"job_starter": ({"start_job": 0.25}, JobStarter), "speed_gate": ({"close": 0.3}, SpeedGate)}

all_right = handed_in(labeler=None, dock=None, collector=None, rider=None)
all_wrong = handed_in(**EACH)
one_left_out = Team(*audited(lambda: {"labeler": LABELER, "dock": DOCK}))
without_a_class = handed_in(dock={"open_gate": 0.15})
two_not_found = handed_in(dock=None, rider=None)
too_short = handed_in(labeler=({"camera": 0.1}, RepairedLabeler))
too_long = handed_in(dock=({"open_gate": 1.0}, RepairedDock))
another_topic = handed_in(collector=({"paths": 0.15}, RepairedCollector))
no_dictionary = handed_in(rider=(0.25, RepairedRider))
cures_that_cure_nothing = handed_in(labeler=(LABELER[0], DeepQueues), dock=(DOCK[0], Locks),
                                    collector=(COLLECTOR[0], Sleeps), rider=(RIDER[0], SwallowsErrors))  # fmt: skip
turns_away = handed_in(dock=(DOCK[0], TurnsAway))
drops_incomplete = handed_in(collector=(COLLECTOR[0], DropsIncomplete))
waits_half_a_second = handed_in(collector=(COLLECTOR[0], WaitsHalfASecond))
remembers_old_doors = handed_in(rider=(RIDER[0], RemembersOldDoors))
remembers_the_last_doors = handed_in(rider=(RIDER[0], RemembersTheLastDoors))
written_anew = handed_in(labeler=(LABELER[0], WrittenAnew))
from_nowhere = handed_in(labeler=(LABELER[0], FromNowhere))
nothing_returned = Team(*audited(lambda: None))
meddles = Team(*audited(lambda: RIGHT_ONES), Meddler)
guesses = Team(Guesses)
PARTS = tuple(name for name, item in vars().items() if callable(item) and not isinstance(item, Team))
