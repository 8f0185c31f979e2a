"""Depots that are right in every order: different designs, each the rest of a program's class.

The first line is the executor. In a template, $stock and the like are names that are drawn.
"""

_SUBSCRIBES = """\
        self.create_subscription(Int32, "/arrive", self.$arrive, 100, callback_group=self.$group)
        self.create_subscription(Int32, "/take", self.$take, 100, callback_group=self.$group)
"""
_REENTRANT = "        self.$group = ReentrantCallbackGroup()\n" + _SUBSCRIBES
_PLAIN = """
    def $arrive(self, msg):
        total = self.$stock + msg.data
        self.$stock = total
        self.$levels.publish(Int32(data=total))

    def $take(self, msg):
        number = msg.data if msg.data <= self.$stock else 0
        left = self.$stock - number
        self.$stock = left
        self.$levels.publish(Int32(data=left))
        self.$answers.publish(Int32(data=number))
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

RIGHT = {
    "one group": "# MultiThreadedExecutor(4)\n"
    "        self.$group = MutuallyExclusiveCallbackGroup()\n" + _SUBSCRIBES + _PLAIN,
    "one thread": "# SingleThreadedExecutor()\n" + _REENTRANT + _PLAIN,
    "lock": "# MultiThreadedExecutor(4)\n"
    "        self.$lock = threading.Lock()\n" + _REENTRANT + """
    def $arrive(self, msg):
        with self.$lock:
            total = self.$stock + msg.data
            self.$stock = total
            self.$levels.publish(Int32(data=total))

    def $take(self, msg):
        with self.$lock:
            number = msg.data if msg.data <= self.$stock else 0
            left = self.$stock - number
            self.$stock = left
            if number:
                self.$levels.publish(Int32(data=left))
        self.$answers.publish(Int32(data=number))
""",
    "lock in a method": "# MultiThreadedExecutor(4)\n"
    "        self.$lock = threading.RLock()\n" + _REENTRANT + """
    def $arrive(self, msg):
        self.$serve(msg.data)

    def $take(self, msg):
        if self.$serve(-msg.data):
            self.$answers.publish(msg)
        else:
            self.$answers.publish(Int32())

    def $serve(self, change):
        self.$lock.acquire()
        try:
            total = self.$stock + change
            if total < 0:
                return False
            self.$stock = total
            self.$levels.publish(Int32(data=total))
            return True
        finally:
            self.$lock.release()
""",
    "queue": "# MultiThreadedExecutor(4)\n"
    "        self.$waiting = SimpleQueue()\n"
    "        threading.Thread(target=self.run, daemon=True).start()\n" + _REENTRANT + """
    def $arrive(self, msg):
        self.$waiting.put(("arrive", msg.data))

    def $take(self, msg):
        self.$waiting.put(("take", msg.data))

    def run(self):
        while True:
            self.$serve(*self.$waiting.get())
""" + _ONE_AT_A_TIME,
    "condition": "# MultiThreadedExecutor(4)\n"
    "        self.$waiting = deque()\n"
    "        self.$lock = threading.Condition()\n"
    "        threading.Thread(target=self.run, daemon=True).start()\n" + _REENTRANT + """
    def $arrive(self, msg):
        with self.$lock:
            self.$waiting.append(("arrive", msg.data))
            self.$lock.notify()

    def $take(self, msg):
        with self.$lock:
            self.$waiting.append(("take", msg.data))
            self.$lock.notify()

    def run(self):
        while True:
            with self.$lock:
                self.$lock.wait_for(lambda: self.$waiting)
                kind, number = self.$waiting.popleft()
            self.$serve(kind, number)
""" + _ONE_AT_A_TIME,
    "timer": "# MultiThreadedExecutor(4)\n"
    "        self.$waiting = deque()\n"
    "        self.create_timer(0.02, self.tick)\n" + _REENTRANT + """
    def $arrive(self, msg):
        self.$waiting.append(("arrive", msg.data))

    def $take(self, msg):
        self.$waiting.append(("take", msg.data))

    def tick(self):
        while self.$waiting:
            self.$serve(*self.$waiting.popleft())
        self.$levels.publish(Int32(data=self.$stock))
""" + _ONE_AT_A_TIME,
    "reserves": "# SingleThreadedExecutor()\n"
    "        self.lifts = deque()\n"
    "        self.create_timer(0.01, self.lift)\n" + _REENTRANT + """
    def $arrive(self, msg):
        self.$stock += msg.data
        self.$levels.publish(Int32(data=self.$stock))

    async def $take(self, msg):
        number = msg.data if msg.data <= self.$stock else 0
        self.$stock -= number
        lifted = rclpy.task.Future()
        self.lifts.append(lifted)
        await lifted
        self.$answers.publish(Int32(data=number))
        self.$levels.publish(Int32(data=self.$stock))

    def lift(self):
        while self.lifts:
            self.lifts.popleft().set_result(None)
""",
}
