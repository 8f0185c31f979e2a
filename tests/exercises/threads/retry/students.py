"""Panels and dispensers at two ends of a radio link: right pairs, and wrong ones named after their defect."""

import itertools
import json
import threading
import uuid

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32, String

from tests.students.teams import Team


class Panel(Node):
    """Nothing is wrong with it; the others change one thing each."""

    period, deadline = 0.1, 2.0  # s

    def __init__(self):
        super().__init__("panel")
        self.link = self.create_publisher(String, "/panel/sent", 10)
        self.reports = self.create_publisher(String, "/reports", 10)
        self.pending = None  # the order's id, its screws, and when it came
        self.create_subscription(Int32, "/orders", self.on_order, 10)
        self.create_subscription(String, "/panel/received", self.on_answer, 10)
        self.create_timer(self.period, self.tick)

    def now(self):
        return self.get_clock().now().nanoseconds / 1e9

    def new_id(self):
        return uuid.uuid4().hex

    def on_order(self, message):
        self.pending = self.new_id(), message.data, self.now()
        self.send()

    def send(self):
        self.link.publish(String(data=f"{self.pending[0]} {self.pending[1]}"))

    def tick(self):
        if self.pending is None:
            return
        if self.now() - self.pending[2] >= self.deadline:
            self.give_up()
        else:
            self.send()

    def give_up(self):
        self.report("unknown")

    def is_for_me(self, answer):
        return self.pending is not None and answer == self.pending[0]

    def on_answer(self, message):
        if self.is_for_me(message.data):
            self.report("done")

    def report(self, text):
        self.reports.publish(String(data=text))
        self.pending = None


class Dispenser(Node):
    """Nothing is wrong with it; the others change one thing each."""

    def __init__(self):
        super().__init__("dispenser")
        self.link = self.create_publisher(String, "/dispenser/sent", 10)
        self.screws = self.create_publisher(Int32, "/screws", 10)
        self.done = set()
        self.create_subscription(String, "/dispenser/received", self.on_request, 10)

    def is_known(self, id, screws):
        return id in self.done

    def remember(self, id, screws):
        self.done.add(id)

    def on_request(self, message):
        id, screws = message.data.split()
        if not self.is_known(id, screws):
            self.remember(id, screws)
            self.screws.publish(Int32(data=int(screws)))
        self.answer(id)

    def answer(self, id):
        self.link.publish(String(data=id))


# -- right ones ----------------------------------------------------------------------------------


class CountingPanel(Panel):
    """Ids are consecutive numbers."""

    def __init__(self):
        self.numbers = itertools.count(1)
        super().__init__()

    def new_id(self):
        return str(next(self.numbers))


class JsonPanel(Panel):
    def send(self):
        self.link.publish(String(data=json.dumps({"id": self.pending[0], "screws": self.pending[1]})))

    def is_for_me(self, answer):
        return self.pending is not None and json.loads(answer) == {"done": self.pending[0]}


class JsonDispenser(Dispenser):
    def on_request(self, message):
        request = json.loads(message.data)
        if request["id"] not in self.done:
            self.done.add(request["id"])
            self.screws.publish(Int32(data=request["screws"]))
        self.answer(request["id"])

    def answer(self, id):
        self.link.publish(String(data=json.dumps({"done": id})))


class StampPanel(Panel):
    """The id is the time at which the order came."""

    def new_id(self):
        return str(self.get_clock().now().nanoseconds)


class FastPanel(Panel):
    period = 0.05


class SlowPanel(Panel):
    period = 0.14


class TimerForEachOrder(Panel):
    """A design of its own: each order has two timers, one that sends and one that ends it."""

    def __init__(self):
        super().__init__()
        self.timers_of_order = []

    def on_order(self, message):
        super().on_order(message)
        self.timers_of_order = [self.create_timer(0.1, self.send), self.create_timer(2.0, self.give_up)]

    def tick(self):
        pass

    def report(self, text):
        for timer in self.timers_of_order:
            timer.cancel()
            self.destroy_timer(timer)
        self.timers_of_order = []
        super().report(text)


class ManyAtATime(Panel):
    """A design of its own: orders are in a dict, so that several can be under way."""

    def __init__(self):
        self.orders = {}
        super().__init__()

    def on_order(self, message):
        id = f"panel-{self.get_clock().now().nanoseconds}"
        self.orders[id] = message.data, self.get_clock().now()
        self.link.publish(String(data=f"{id} {message.data}"))

    def tick(self):
        for id, (screws, begun) in list(self.orders.items()):
            if (self.get_clock().now() - begun).nanoseconds >= 2e9:
                del self.orders[id]
                self.reports.publish(String(data="unknown"))
            else:
                self.link.publish(String(data=f"{id} {screws}"))

    def on_answer(self, message):
        if self.orders.pop(message.data, None):
            self.reports.publish(String(data="done"))


class AwaitsTheAnswer(Panel):
    """A design of its own: the order's callback is a coroutine that waits for the next tick or the answer."""

    def __init__(self):
        self.woken = None
        Node.__init__(self, "panel")
        self.link = self.create_publisher(String, "/panel/sent", 10)
        self.reports = self.create_publisher(String, "/reports", 10)
        others = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Int32, "/orders", self.on_order, 10)
        self.create_subscription(String, "/panel/received", self.on_answer, 10, callback_group=others)
        self.create_timer(0.1, self.tick, callback_group=others)

    async def on_order(self, message):
        id, begun = self.new_id(), self.now()
        self.answered = False
        self.id = id
        while not self.answered and self.now() - begun < 2.0:
            self.link.publish(String(data=f"{id} {message.data}"))
            self.woken = Future()
            await self.woken
        self.reports.publish(String(data="done" if self.answered else "unknown"))
        self.woken = None

    def tick(self):
        if self.woken is not None and not self.woken.done():
            self.woken.set_result(None)

    def on_answer(self, message):
        if self.woken is not None and message.data == self.id and not self.answered:
            self.answered = True
            self.tick()


def panel_with_a_thread():
    """A design of its own: a thread works through the orders, and waits for each answer with a timeout."""
    rclpy.init()
    node = Node("panel")
    link = node.create_publisher(String, "/panel/sent", 10)
    reports = node.create_publisher(String, "/reports", 10)
    state = threading.Condition()
    orders, answers = [], set()

    def put(message):
        with state:
            orders.append(message.data)
            state.notify_all()

    def on_answer(message):
        with state:
            answers.add(message.data)
            state.notify_all()

    def work():
        for number in itertools.count():
            with state:
                state.wait_for(lambda: orders)
                screws = orders.pop(0)
            ends = node.get_clock().now() + Duration(seconds=2.0)
            answered = False
            while not answered and node.get_clock().now() < ends:
                link.publish(String(data=f"{number} {screws}"))
                with state:
                    answered = state.wait_for(lambda number=number: str(number) in answers, 0.1)
            reports.publish(String(data="done" if answered else "unknown"))

    node.create_subscription(Int32, "/orders", put, 10)
    node.create_subscription(String, "/panel/received", on_answer, 10)
    threading.Thread(target=work, daemon=True).start()
    rclpy.spin(node)


class StoresItsAnswers(Dispenser):
    """A design of its own: for each id it stores the answer, and gives it again."""

    def __init__(self):
        super().__init__()
        self.answers = {}

    def on_request(self, message):
        id, screws = message.data.split()
        if id not in self.answers:
            self.screws.publish(Int32(data=int(screws)))
            self.answers[id] = String(data=id)
        self.link.publish(self.answers[id])


class ThreadedDispenser(Dispenser):
    """Its own executor with threads; the callback's group keeps its calls apart."""

    @staticmethod
    def main():
        rclpy.init()
        executor = MultiThreadedExecutor(4)
        executor.add_node(ThreadedDispenser())
        executor.spin()


class ForgetsAfterTenSeconds(Dispenser):
    """Bounded memory: an id is forgotten when no copy of its messages can come any more."""

    def __init__(self):
        super().__init__()
        self.done = {}

    def is_known(self, id, screws):
        now = self.get_clock().now()
        self.done = {known: at for known, at in self.done.items() if (now - at).nanoseconds < 10e9}
        return id in self.done

    def remember(self, id, screws):
        self.done[id] = self.get_clock().now()


class NewestNumberOnly(Dispenser):
    """Right for numbered orders of which only one is under way: what isn't newer is known."""

    newest = 0

    def is_known(self, id, screws):
        return int(id) <= self.newest

    def remember(self, id, screws):
        self.newest = int(id)


right = Team(Panel, Dispenser)
counts = Team(CountingPanel, Dispenser)
json_texts = Team(JsonPanel, JsonDispenser)
stamps = Team(StampPanel, Dispenser)
fast = Team(FastPanel, Dispenser)
slow = Team(SlowPanel, Dispenser)
timer_for_each_order = Team(TimerForEachOrder, Dispenser)  # a design of its own
many_at_a_time = Team(ManyAtATime, Dispenser)  # a design of its own
awaits_the_answer = Team(AwaitsTheAnswer, Dispenser)  # a design of its own
thread = Team(panel_with_a_thread, Dispenser)  # a design of its own
stores_its_answers = Team(Panel, StoresItsAnswers)  # a design of its own
threaded_dispenser = Team(Panel, ThreadedDispenser.main)
forgets_after_ten_seconds = Team(Panel, ForgetsAfterTenSeconds)
newest_number_only = Team(CountingPanel, NewestNumberOnly)


# -- wrong ones ----------------------------------------------------------------------------------


class NeverRetries(Panel):
    def tick(self):
        if self.pending is not None and self.now() - self.pending[2] >= self.deadline:
            self.give_up()


class FirstOrderOnly(Panel):
    orders = 0

    def on_order(self, message):
        self.orders += 1
        if self.orders == 1:
            super().on_order(message)


class RetriesForEver(Panel):
    def tick(self):
        if self.pending is not None:
            self.send()


class RetriesTooRarely(Panel):
    """The link loses two messages in a row, so three answers to nine messages may be needed."""

    period = 0.9


class NewIdForEachRetry(Panel):
    def send(self):
        self.pending = self.new_id(), *self.pending[1:]
        super().send()


class NewIdForEachRetryAcceptsAll(NewIdForEachRetry):
    """It knows all ids of this order."""

    def __init__(self):
        self.ids = set()
        super().__init__()

    def on_order(self, message):
        self.ids.clear()
        super().on_order(message)

    def send(self):
        super().send()
        self.ids.add(self.pending[0])

    def is_for_me(self, answer):
        return self.pending is not None and answer in self.ids


class TakesAnyAnswer(Panel):
    def is_for_me(self, answer):
        return self.pending is not None


class ReportsEachAnswer(Panel):
    def on_answer(self, message):
        if self.pending is not None and message.data == self.pending[0]:
            self.reports.publish(String(data="done"))

    def give_up(self):
        self.pending = None


class SendsOnAfterTheAnswer(Panel):
    answered = False

    def on_order(self, message):
        self.answered = False
        super().on_order(message)

    def give_up(self):
        if not self.answered:
            super().give_up()

    def on_answer(self, message):
        if self.is_for_me(message.data) and not self.answered:
            self.answered = True
            self.reports.publish(String(data="done"))


class SaysDoneAtOnce(Panel):
    def on_order(self, message):
        super().on_order(message)
        self.reports.publish(String(data="done"))

    def report(self, text):
        self.pending = None


class GivesUpTooEarly(Panel):
    deadline = 0.5


class GivesUpTooLate(Panel):
    deadline = 2.5


class SaysFailed(Panel):
    """It can't know that."""

    def give_up(self):
        self.report("failed")


class GivesUpSilently(Panel):
    def give_up(self):
        self.pending = None


class SaysUnknownAgainAndAgain(Panel):
    def give_up(self):
        self.reports.publish(String(data="unknown"))


class SendsOnAfterGivingUp(Panel):
    given_up = False

    def on_order(self, message):
        self.given_up = False
        super().on_order(message)

    def tick(self):
        if self.pending is None:
            return
        if not self.given_up and self.now() - self.pending[2] >= 2.0:
            self.reports.publish(String(data="unknown"))
            self.given_up = True
        self.send()


class NoId(Panel):
    def send(self):
        self.link.publish(String(data=str(self.pending[1])))

    def is_for_me(self, answer):
        return self.pending is not None


class DispensesEach(Dispenser):
    def on_request(self, message):
        self.screws.publish(Int32(data=int(message.data.split()[-1])))
        self.answer(message.data.split()[0])


class ComparesTheNumbers(Dispenser):
    """An order for as many screws as an earlier one isn't carried out."""

    def is_known(self, id, screws):
        return screws in self.done

    def remember(self, id, screws):
        self.done.add(screws)


class RemembersTheLastOnly(Dispenser):
    def remember(self, id, screws):
        self.done = {id}


class ForgetsAfterOneSecond(ForgetsAfterTenSeconds):
    def is_known(self, id, screws):
        now = self.get_clock().now()
        self.done = {known: at for known, at in self.done.items() if (now - at).nanoseconds < 1e9}
        return id in self.done


class AnswersOnce(Dispenser):
    """A copy gets no answer; if the first answer is lost, the panel never gets one."""

    def on_request(self, message):
        id, screws = message.data.split()
        if id not in self.done:
            self.done.add(id)
            self.screws.publish(Int32(data=int(screws)))
            self.answer(id)


class AnswersOnly(Dispenser):
    def on_request(self, message):
        self.answer(message.data.split()[0])


class DispensesLater(Dispenser):
    """It answers, and gives out the screws a second later."""

    def on_request(self, message):
        id, screws = message.data.split()
        if id not in self.done:
            self.done.add(id)
            timer = self.create_timer(1.0, lambda: (timer.cancel(), self.give(screws)))
        self.answer(id)

    def give(self, screws):
        self.screws.publish(Int32(data=int(screws)))


class SubscribesToOrders(Dispenser):
    """It bypasses the link."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Int32, "/orders", lambda message: self.screws.publish(message), 10)

    def on_request(self, message):
        self.answer(message.data.split()[0])


class WatchesTheScrews(Panel):
    """It bypasses the link: screws on /screws are an answer."""

    def __init__(self):
        super().__init__()
        self.create_subscription(Int32, "/screws", self.on_screws, 10)

    def on_screws(self, message):
        if self.pending is not None:
            self.report("done")


never_retries = Team(NeverRetries, Dispenser)
first_order_only = Team(FirstOrderOnly, Dispenser)
retries_for_ever = Team(RetriesForEver, Dispenser)
retries_too_rarely = Team(RetriesTooRarely, Dispenser)
new_id_for_each_retry = Team(NewIdForEachRetry, Dispenser)
new_id_for_each_retry_accepts_all = Team(NewIdForEachRetryAcceptsAll, Dispenser)
takes_any_answer = Team(TakesAnyAnswer, Dispenser)
reports_each_answer = Team(ReportsEachAnswer, Dispenser)
sends_on_after_the_answer = Team(SendsOnAfterTheAnswer, Dispenser)
says_done_at_once = Team(SaysDoneAtOnce, Dispenser)
gives_up_too_early = Team(GivesUpTooEarly, Dispenser)
gives_up_too_late = Team(GivesUpTooLate, Dispenser)
says_failed = Team(SaysFailed, Dispenser)
gives_up_silently = Team(GivesUpSilently, Dispenser)
says_unknown_again_and_again = Team(SaysUnknownAgainAndAgain, Dispenser)
sends_on_after_giving_up = Team(SendsOnAfterGivingUp, Dispenser)
no_id = Team(NoId, DispensesEach)
dispenses_each = Team(Panel, DispensesEach)
compares_the_numbers = Team(Panel, ComparesTheNumbers)
remembers_the_last_only = Team(Panel, RemembersTheLastOnly)
forgets_after_one_second = Team(Panel, ForgetsAfterOneSecond)
answers_once = Team(Panel, AnswersOnce)
answers_only = Team(Panel, AnswersOnly)
dispenses_later = Team(Panel, DispensesLater)
subscribes_to_orders = Team(Panel, SubscribesToOrders)
watches_the_screws = Team(WatchesTheScrews, Dispenser)
panel_alone = Team(Panel)
PARTS = tuple(name for name, item in vars().items() if callable(item) and not isinstance(item, Team))
