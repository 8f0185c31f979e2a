"""Tests of a function that says how fast a robot may drive: right ones, and wrong ones."""

import itertools
import math
import random
import statistics
import time

from rclpy.node import Node
from std_msgs.msg import Float64MultiArray, String

from grader.exercises.safety import bench

PLACES = (-0.1, 0.0, 0.05, 0.15, 0.2, 0.21, 0.25, 0.3, 0.4, 0.45, 0.5, 1.0, 3.0, math.inf)
REQUESTS = (-9.0, -0.6, -0.5, -0.2, 0.0, 0.1, 0.3, 0.5, 0.6, 9.0)
TINY = 1e-3


def right(distance, requested):
    if requested < 0:
        return max(requested, -0.5)
    return min(requested, 0.5, math.sqrt(max(0.0, distance - 0.2)))


def never_above_the_request_or_the_limit(safe_speed):
    for distance in PLACES:
        for requested in REQUESTS[4:]:
            assert safe_speed(distance, requested) <= min(requested, 0.5) + TINY


def stops_in_time(safe_speed):
    for distance in PLACES:
        speed = safe_speed(distance, 0.5)
        assert speed == 0 or speed**2 / (2 * 0.5) <= distance - 0.2 + TINY


def no_slower_than_needed(safe_speed):
    assert math.isclose(safe_speed(math.inf, 0.4), 0.4, abs_tol=TINY)
    assert math.isclose(safe_speed(0.29, 0.5), 0.3, abs_tol=TINY)
    assert math.isclose(safe_speed(9.0, 9.0), 0.5, abs_tol=TINY)


def backwards_is_free(safe_speed):
    for distance in PLACES:
        assert math.isclose(safe_speed(distance, -0.3), -0.3, abs_tol=TINY)
        assert math.isclose(safe_speed(distance, -3.0), -0.5, abs_tol=TINY)


def nonsense_stops(safe_speed):
    assert safe_speed(math.nan, 0.3) == 0
    assert safe_speed(1.0, math.nan) == 0


def as_the_formula_says(safe_speed):
    for distance in PLACES:
        for requested in REQUESTS:
            assert math.isclose(safe_speed(distance, requested), right(distance, requested), abs_tol=TINY)


def as_the_formula_says_at_drawn_places(safe_speed):
    chance = random.Random(1)
    for _ in range(60):
        distance, requested = chance.uniform(-0.1, 1.0), chance.uniform(-1.0, 1.0)
        assert math.isclose(safe_speed(distance, requested), right(distance, requested), abs_tol=TINY)


def tests_the_copy(safe_speed):
    for distance in PLACES:
        assert right(distance, 0.5) <= 0.5


def asserts_nothing(safe_speed):
    for distance in PLACES:
        safe_speed(distance, 0.5)


def exact(safe_speed):
    for distance in PLACES:
        for requested in REQUESTS:
            assert safe_speed(distance, requested) == right(distance, requested)


def sleeps_and_asserts_nothing(safe_speed):
    time.sleep(0.2)
    assert safe_speed(1.0, 0.3) is not None


def too_strict_at_the_edge(safe_speed):
    assert safe_speed(0.29, 0.5) < 0.29


def one_case(safe_speed):
    assert safe_speed(9.0, 0.3) == 0.3


def divides_by_zero(safe_speed):
    assert 1 / safe_speed(0.1, 0.3)


def never_ends(safe_speed):
    speed = safe_speed(1.0, 0.3)
    # In one line: wherever it is stopped, it is stopped there.
    all(speed < 9.0 for _ in itertools.count())


def asks_without_end(safe_speed):
    while safe_speed(1.0, 0.3) < 9.0:
        pass


PARTS = (
    "asks_without_end",
    *("bench", "right", "never_above_the_request_or_the_limit", "stops_in_time", "no_slower_than_needed"),
    *("backwards_is_free", "nonsense_stops", "as_the_formula_says", "tests_the_copy", "asserts_nothing"),
    *("exact", "sleeps_and_asserts_nothing", "too_strict_at_the_edge", "one_case", "divides_by_zero"),
    "never_ends",
    "as_the_formula_says_at_drawn_places",
)


def properties():
    bench(
        never_above_the_request_or_the_limit,
        stops_in_time,
        no_slower_than_needed,
        backwards_is_free,
        nonsense_stops,
    )()


def one_formula():
    """A design of its own: a second formula, at many places."""
    bench(as_the_formula_says, nonsense_stops)()


def formula_and_properties():
    bench(never_above_the_request_or_the_limit, as_the_formula_says, nonsense_stops)()


def copy_tested():
    """The tests never call the function that they are given."""
    bench(tests_the_copy)()


def nothing_asserted():
    bench(asserts_nothing)()


def sleeping():
    bench(sleeps_and_asserts_nothing)()


def to_the_last_digit():
    """False alarm: right ones differ in the last digits."""
    bench(exact, nonsense_stops)()


def stricter_than_the_contract():
    bench(too_strict_at_the_edge, stops_in_time)()


def one_example():
    bench(one_case)()


def only_the_limits():
    bench(never_above_the_request_or_the_limit)()


def no_nonsense_and_nothing_backwards():
    bench(never_above_the_request_or_the_limit, stops_in_time)()


def with_an_error_of_its_own():
    bench(divides_by_zero)()


def without_an_end():
    bench(never_ends)()


def with_endless_questions():
    bench(asks_without_end)()


class Voter(Node):
    """Asks all candidates about all places, and takes what most of them say for right."""

    def __init__(self):
        super().__init__("voter")
        self.answers = {}
        self.questions = self.create_publisher(Float64MultiArray, "/question", 1000)
        self.verdicts = self.create_publisher(String, "/verdict", 100)
        self.create_subscription(Float64MultiArray, "/answer", self.on_answer, 1000)
        places = itertools.product((*PLACES, math.nan), (*REQUESTS, math.nan), range(1, 14))
        self.places = [[float(number), distance, requested] for distance, requested, number in places]
        self.create_timer(0.02, self.ask)

    def on_answer(self, answer):
        number, distance, requested, speed = answer.data
        said = self.answers.setdefault((str(distance), str(requested)), {})
        said[int(number)] = 9.9 if math.isnan(speed) else speed

    def ask(self):
        if not self.places and self.answers:
            self.vote()
        if self.questions.get_subscription_count():
            for place in self.places[:8]:
                self.questions.publish(Float64MultiArray(data=place))
            del self.places[:8]

    def vote(self):
        for number in range(1, 14):
            fits = all(
                number in said and abs(said[number] - statistics.median(said.values())) < TINY
                for said in self.answers.values()
            )
            self.verdicts.publish(String(data=f"{number} {'passed' if fits else 'failed'}"))
        self.answers = {}


def drawn_places():
    """Right, too: the same numbers are drawn each time."""
    bench(as_the_formula_says_at_drawn_places, no_slower_than_needed, nonsense_stops)()
