"""A client that must not freeze while it waits for an answer."""

from grader.checks import Missed, publishes, series
from grader.checks.services import call_text, has_client, sent_at
from grader.checks.topics import keeps_pace
from grader.companions.service_servers import SlowAdder, WheelEncoders
from grader.exercise import Exercise
from grader.responses import Window
from grader.variants import Variants
from sim.evidence import Call, Recording

MOST = 1.5  # questions a second, and messages for each answer: more are guesses
ADD, TOTAL = "/add_two_ints", "/ticks/total"
GROUPS = ("While look waits for a response, or awaits it, nothing else in its callback group runs. Put its "
          "timer and the client in a separate ReentrantCallbackGroup; or use a done callback.")

ticks = Exercise("ticks", "A node that freezes", seconds=10, companions=[SlowAdder, WheelEncoders],
                 seeds=(1, 2), variants=Variants(
    {"period": (1.0, 0.5), "often": ("once a second", "twice a second"),
     "Often": ("Once a second", "Twice a second"), "rate": (1, 2), "after": ("one second", "half a second")},
    texts=("{often}", "{Often}", "create_timer({period}, self.look", "should show {rate} Hz",
           "After {after} the heart"),
))


@ticks.check(4)
def calls_every_second(run: Recording) -> list[Call]:
    """Once a second the node calls /add_two_ints."""
    made = has_client(run, ADD, "example_interfaces/srv/AddTwoInts")
    period = ticks.drawn.period
    due = int(run.seconds / period) - 1
    if not 0.8 * due <= len(made) <= MOST * run.seconds / period:
        hint = (f"Let a timer with a period of {period:g} s call look, and send the request there: "
                "self.client.call_async(request).")
        raise Missed(f"{due} requests in {run.seconds:g} s", f"{len(made)}", hint)
    return made


@ticks.check(4, after=calls_every_second)
def publishes_the_totals(run: Recording, made: list[Call]) -> None:
    """Each response is published on /ticks/total (Int64) as soon as it arrives."""
    publishes(run, TOTAL, "std_msgs/msg/Int64")
    for call in made:
        if call.answered is None:
            continue
        total = call.response.sum
        sent = Window.after(call.answered, 0.2).rows(run.messages(TOTAL))
        sums = [row.message.data for row in sent]
        if total not in sums:
            saw = f"{', '.join(map(str, sums)) or 'no message'} in the 0.2 s after it"
            guess = "Publish the sum from the response, once it has arrived: answer.sum."
            raise Missed(f"{total} on {TOTAL}, from the response at {call.answered:.3g} s", saw, guess=guess)
    count, answered = len(run.messages(TOTAL)), sum(call.answered is not None for call in made)
    if count > MOST * answered:
        hint = "Publish one sum for each response: the one in it."
        raise Missed(f"one message for each of {answered} responses", f"{count} on {TOTAL}", hint)


@ticks.check(2, after=calls_every_second)
def sends_the_newest_ticks(run: Recording, made: list[Call]) -> None:
    """Each request has the newest ticks of both wheels."""
    counts = [series(run, f"/ticks/{side}", "data") for side in ("left", "right")]
    for call in made:
        # Two of each: a message published at the moment of the request may arrive before or after it.
        left, right = ([value for at, value in side if at <= sent_at(call)][-2:] for side in counts)
        a, b = call.request.a, call.request.b
        if not (a in left and b in right) and not (b in left and a in right):
            hint = "Build a new AddTwoInts.Request(a=self.left, b=self.right) for each call."
            raise Missed(f"a={left[-1]}, b={right[-1]}", call_text(call), hint)


@ticks.check(4, after=sends_the_newest_ticks)
def heart_goes_on(run: Recording) -> None:
    """The heart keeps beating at 10 Hz, even while the node waits for a response."""
    keeps_pace(run, "/heartbeat", GROUPS)
