"""Each QoS policy set at one end only: the listener's QoS, the speaker's, and what the speaker does."""

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

SHORT, HALF = Duration(seconds=0.1), Duration(seconds=0.5)
PLAIN = QoSProfile(depth=50)  # reliable, volatile, no deadline, automatic, no lifespan
BEST_EFFORT = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=50, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FIVE = QoSProfile(depth=5)
EVERYTHING = QoSProfile(history=HistoryPolicy.KEEP_ALL)
DEADLINE = QoSProfile(depth=50, deadline=HALF)
BY_HAND = QoSProfile(
    depth=50, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC, liveliness_lease_duration=HALF
)
BRIEF = QoSProfile(depth=50, lifespan=SHORT)
BRIEFLY_LATCHED = QoSProfile(depth=50, lifespan=HALF, durability=DurabilityPolicy.TRANSIENT_LOCAL)

THRICE = [(0.5, "say"), (0.7, "say"), (1.0, "say"), (3.2, "leave")]
ONCE = [(0.5, "say"), (2.2, "leave")]
LATE = [(0.2, "say"), (0.8, "say"), (1.5, "say"), (2.2, "leave")]  # the listener joins at 1 s
BURST = [(0.5, "say"), (0.8, "burst"), (2.5, "leave")]  # the listener sleeps from 0.5 s to 1.3 s

ONE_SIDED = {
    "reliability, offered alone": (BEST_EFFORT, PLAIN, ONCE),
    "reliability, requested alone": (PLAIN, BEST_EFFORT, ONCE),
    "durability, offered alone": (PLAIN, LATCHED, LATE),
    "durability, requested alone": (LATCHED, PLAIN, LATE),
    "durability, at both ends": (LATCHED, LATCHED, LATE),
    "history, 5 at the speaker alone": (EVERYTHING, FIVE, BURST),
    "history, 5 at the listener alone": (FIVE, EVERYTHING, BURST),
    "deadline, offered alone": (PLAIN, DEADLINE, ONCE),
    "deadline, requested alone": (DEADLINE, PLAIN, ONCE),
    "liveliness, offered alone": (PLAIN, BY_HAND, ONCE),
    "liveliness, requested alone": (BY_HAND, PLAIN, ONCE),
    "lifespan, offered alone": (PLAIN, BRIEF, THRICE),
    "lifespan, requested alone": (BRIEF, PLAIN, THRICE),
    "lifespan, offered alone, to a late joiner": (LATCHED, BRIEFLY_LATCHED, LATE),
}
