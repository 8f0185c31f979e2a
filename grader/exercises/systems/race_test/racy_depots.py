"""Depots with a race: each is right in the usual order or with few messages, and wrong in other orders.

The first line is the executor. In a template, $stock and the like are names that are drawn.
"""

_SUBSCRIBES = """\
        self.create_subscription(Int32, "/arrive", self.$arrive, 100, callback_group=self.$group)
        self.create_subscription(Int32, "/take", self.$take, 100, callback_group=self.$group)
"""
_REENTRANT = "        self.$group = ReentrantCallbackGroup()\n" + _SUBSCRIBES
_THREADS = "# MultiThreadedExecutor(4)\n"
_LOCK = "        self.$lock = threading.Lock()\n"
_ARRIVE_LOCKED = """
    def $arrive(self, msg):
        with self.$lock:
            total = self.$stock + msg.data
            self.$stock = total
            self.$levels.publish(Int32(data=total))
"""
_ARRIVE = """
    def $arrive(self, msg):
        before = self.$stock
        after = before + msg.data
        level = Int32()
        level.data = after
        self.$stock = after
        self.$levels.publish(level)
"""
_TAKE = """
    def $take(self, msg):
        there = self.$stock
        number = msg.data if msg.data <= there else 0
        left = there - number
        answer = Int32(data=number)
        level = Int32(data=left)
        self.$stock = left
        self.$levels.publish(level)
        self.$answers.publish(answer)
"""
_STORE = """
    def $arrive(self, msg):
        self.$waiting.append(("arrive", msg.data))

    def $take(self, msg):
        self.$waiting.append(("take", msg.data))
"""
_ONE_AT_A_TIME = """
    def $serve(self, kind, number):
        if kind == "arrive":
            change, answer = number, None
        else:
            answer = number if number <= self.$stock else 0
            change = -answer
        total = self.$stock + change
        self.$stock = total
        if answer is not None:
            self.$answers.publish(Int32(data=answer))
        self.$levels.publish(Int32(data=total))
"""

# Races that only one line of the contract can see: every test is tried on these.
NEGATIVE = "checks before the lock", "releases the lock too early"
ANSWERS = "answers twice", "drops what comes meanwhile"
RACY = {
    "no lock": _THREADS + _REENTRANT + _ARRIVE + _TAKE,
    "two groups": _THREADS + """\
        self.create_subscription(
            Int32, "/arrive", self.$arrive, 100, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_subscription(
            Int32, "/take", self.$take, 100, callback_group=MutuallyExclusiveCallbackGroup())
""" + _ARRIVE + _TAKE,
    "checks before the lock": _THREADS + _LOCK + _REENTRANT + _ARRIVE_LOCKED + """
    def $take(self, msg):
        if not self.$serve(msg.data):
            self.$answers.publish(Int32(data=0))
            return
        answer = Int32()
        answer.data = msg.data
        with self.$lock:
            left = self.$stock - msg.data
            self.$stock = left
            self.$levels.publish(Int32(data=left))
            self.$answers.publish(answer)

    def $serve(self, number):
        enough = number <= self.$stock
        return enough
""",
    "releases the lock too early": _THREADS + _LOCK + _REENTRANT + _ARRIVE_LOCKED + """
    def $take(self, msg):
        with self.$lock:
            enough = msg.data <= self.$stock
        answer = Int32()
        if enough:
            answer.data = msg.data
            self.$serve(msg.data)
        self.$answers.publish(answer)

    def $serve(self, number):
        with self.$lock:
            left = self.$stock - number
            self.$stock = left
            self.$levels.publish(Int32(data=left))
""",
    "drops what comes meanwhile": _THREADS + _LOCK + _REENTRANT + _ARRIVE_LOCKED + """
    def $take(self, msg):
        if not self.$lock.acquire(blocking=False):
            return
        there = self.$stock
        number = msg.data if msg.data <= there else 0
        left = there - number
        self.$stock = left
        self.$levels.publish(Int32(data=left))
        self.$answers.publish(Int32(data=number))
        self.$lock.release()
""",
    "locks half": _THREADS + _LOCK + _REENTRANT + _ARRIVE + """
    def $take(self, msg):
        with self.$lock:
            number = msg.data if msg.data <= self.$stock else 0
            left = self.$stock - number
            level = Int32(data=left)
            self.$stock = left
            self.$levels.publish(level)
            self.$answers.publish(Int32(data=number))
""",
    "two locks": _THREADS + """\
        self.$lock, self.$serve = threading.Lock(), threading.Lock()
""" + _REENTRANT + """
    def $arrive(self, msg):
        with self.$lock:
            before = self.$stock
            after = before + msg.data
            level = Int32(data=after)
            self.$stock = after
            self.$levels.publish(level)

    def $take(self, msg):
        with self.$serve:
            there = self.$stock
            number = msg.data if msg.data <= there else 0
            left = there - number
            answer = Int32(data=number)
            self.$stock = left
            self.$levels.publish(Int32(data=left))
            self.$answers.publish(answer)
""",
    "publishes after the lock": _THREADS + _LOCK + _REENTRANT + """
    def $arrive(self, msg):
        with self.$lock:
            self.$stock += msg.data
            total = self.$stock
        level = Int32()
        level.data = total
        self.$levels.publish(level)

    def $take(self, msg):
        with self.$lock:
            number = msg.data if msg.data <= self.$stock else 0
            self.$stock -= number
            left = self.$stock
        level = Int32()
        level.data = left
        self.$answers.publish(Int32(data=number))
        self.$levels.publish(level)
""",
    "reads before the lock": _THREADS + _LOCK + _REENTRANT + _ARRIVE_LOCKED + """
    def $take(self, msg):
        there = self.$stock
        number = msg.data if msg.data <= there else 0
        with self.$lock:
            self.$stock = there - number
            self.$levels.publish(Int32(data=self.$stock))
            self.$answers.publish(Int32(data=number))
""",
    "a lock for each call": _THREADS + _REENTRANT + """
    def $arrive(self, msg):
        with threading.Lock():
            total = self.$stock + msg.data
            level = Int32(data=total)
            self.$stock = total
            self.$levels.publish(level)

    def $take(self, msg):
        with threading.Lock():
            number = msg.data if msg.data <= self.$stock else 0
            left = self.$stock - number
            self.$stock = left
            self.$levels.publish(Int32(data=left))
            self.$answers.publish(Int32(data=number))
""",
    "clears what it has not served": _THREADS + """\
        self.$waiting = []
        self.create_timer(0.02, self.tick)
""" + _REENTRANT + _STORE + """
    def tick(self):
        batch = list(self.$waiting)
        for kind, number in batch:
            self.$serve(kind, number)
        self.$waiting.clear()
""" + _ONE_AT_A_TIME,
    "lost wake-up": _THREADS + """\
        self.$waiting = deque()
        self.$lock = threading.Event()
        threading.Thread(target=self.run, daemon=True).start()
""" + _REENTRANT + """
    def $arrive(self, msg):
        self.$waiting.append(("arrive", msg.data))
        self.$lock.set()

    def $take(self, msg):
        self.$waiting.append(("take", msg.data))
        self.$lock.set()

    def run(self):
        while True:
            self.$lock.wait()
            batch = list(self.$waiting)
            for kind, number in batch:
                self.$serve(kind, number)
                self.$waiting.popleft()
            self.$lock.clear()
""" + _ONE_AT_A_TIME,
    "answers twice": _THREADS + _LOCK + """\
        self.number, self.$waiting = 0, {}
        self.create_timer(0.02, self.$serve)
""" + _REENTRANT + _ARRIVE_LOCKED + """
    def $take(self, msg):
        with self.$lock:
            self.number += 1
            self.$waiting[self.number] = msg.data
        self.$serve()

    def $serve(self):
        for key, wanted in list(self.$waiting.items()):
            with self.$lock:
                number = wanted if wanted <= self.$stock else 0
                self.$stock -= number
                self.$levels.publish(Int32(data=self.$stock))
                self.$answers.publish(Int32(data=number))
            self.$waiting.pop(key, None)
""",
}
