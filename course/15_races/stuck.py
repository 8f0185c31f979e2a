"""Two threads take two locks in different orders, and wait for each other. After a second it prints where."""

import faulthandler
import threading

corridor, lift = threading.Lock(), threading.Lock()
both_hold_one = threading.Barrier(2)


def go_up():
    """Take the corridor, then the lift."""
    with corridor:
        both_hold_one.wait()
        with lift:
            print("up")


def go_down():
    """Take the lift, then the corridor."""
    with lift:
        both_hold_one.wait()
        with corridor:
            print("down")


faulthandler.dump_traceback_later(1.0, exit=True)
threads = [threading.Thread(target=function) for function in (go_up, go_down)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
