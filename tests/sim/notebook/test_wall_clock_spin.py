"""The official tutorial, pasted whole into a notebook: it is stopped with a sentence, and rclpy is clean."""

import pytest

from tests.patience import PATIENCE
from tests.sim.notebook.test_kernel import Kernel

TUTORIAL = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class MinimalPublisher(Node):
    def __init__(self):
        super().__init__("minimal_publisher")
        self.publisher_ = self.create_publisher(String, "topic", 10)
        self.count = 0
        self.create_timer(0.5, self.timer_callback)

    def timer_callback(self):
        self.publisher_.publish(String(data="Hello World"))
        self.count += 1

def main(args=None):
    rclpy.init(args=args)
    minimal_publisher = MinimalPublisher()
    rclpy.spin(minimal_publisher)
    minimal_publisher.destroy_node()
    rclpy.shutdown()
"""
PASTED = TUTORIAL + '\nif __name__ == "__main__":\n    main()\n'
WHY = (
    "was stopped after 2 s: in a notebook it waits on the wall clock and never returns, and no robot can "
    "reach it. Write run({instead}, with `from sim import run`: it runs the same code in simulated time, "
    'with a robot if you add world="room". On a real robot the code stays as it is. rclpy has been shut down.'
)
CLEAN = "rclpy.ok(), rclpy.init(), Node('again').destroy_node(), rclpy.shutdown()"


@pytest.fixture(scope="module")
def kernel(tmp_path_factory):
    kernel = Kernel(tmp_path_factory.mktemp("spin") / "spin.ipynb")
    yield kernel
    kernel.client.stop_channels()
    kernel.manager.shutdown_kernel(now=True)


def test_a_whole_tutorial_says_what_to_write_and_leaves_rclpy_clean(kernel):
    why = WHY.format(instead="main, seconds=10) in place of main()")
    assert kernel.run(PASTED, "pasted").strip() == f"SpinOutsideRunError: rclpy.spin() {why}"
    assert kernel.run(CLEAN, "after").strip() == "(False, None, None, None)"
    assert kernel.run(PASTED, "pasted").strip() == f"SpinOutsideRunError: rclpy.spin() {why}"
    assert "MinimalPublisher" not in kernel.run(
        "from sim import run; run(main, seconds=2).failure", "instead"
    )


def test_a_program_that_cleans_up_by_itself_shows_the_same_sentence(kernel):
    kernel.run(TUTORIAL, "tutorial")
    careful = """
def careful():
    rclpy.init()
    node = MinimalPublisher()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()
careful()
"""
    why = WHY.format(instead="careful, seconds=10) in place of careful()")
    assert kernel.run(careful, "careful").strip() == f"SpinOutsideRunError: rclpy.spin() {why}"
    assert kernel.run(CLEAN, "after").strip() == "(False, None, None, None)"


def test_lines_without_a_function_and_executors(kernel):
    kernel.run(TUTORIAL, "tutorial")
    why = WHY.format(instead="MinimalPublisher, seconds=10) in place of these lines")
    shown = kernel.run("rclpy.init()\nrclpy.spin(MinimalPublisher())", "lines").strip()
    assert shown == f"SpinOutsideRunError: rclpy.spin() {why}"
    executor = (
        "from rclpy.executors import SingleThreadedExecutor\nrclpy.init()\nSingleThreadedExecutor().spin()"
    )
    why = WHY.format(instead="main, seconds=10)")
    assert kernel.run(executor, "executor").strip() == f"SpinOutsideRunError: executor.spin() {why}"
    forever = "rclpy.init()\nnode = Node('asks')\nrclpy.spin_until_future_complete(node, rclpy.Future())"
    shown = kernel.run(forever, "future").strip()
    assert shown == f"SpinOutsideRunError: spin_until_future_complete() {why}"
    assert kernel.run(CLEAN, "after").strip() == "(False, None, None, None)"


@pytest.fixture
def patient_kernel(kernel):
    """The kernel with a limit that no machine is too slow for."""
    kernel.run("from sim.notebook import spin_outside_run", "import")
    kernel.run(f"usual, spin_outside_run.LIMIT = spin_outside_run.LIMIT, {PATIENCE}", "patient")
    yield kernel
    kernel.run("spin_outside_run.LIMIT = usual", "usual")


def test_a_spin_with_an_end_is_left_alone(patient_kernel):
    kernel = patient_kernel
    kernel.run(TUTORIAL, "tutorial")
    code = "rclpy.init()\nnode = MinimalPublisher()\nnode.create_timer(0.6, rclpy.shutdown)\n"
    code += "rclpy.spin(node)\nnode.count"
    assert kernel.run(code, "ends").strip() == "1"
    code = "rclpy.init()\nnode = Node('n')\nrclpy.spin_once(node, timeout_sec=0.1)\nrclpy.ok()"
    assert kernel.run(code, "once").strip() == "True"
    assert kernel.run("rclpy.shutdown()", "end").strip() == ""


def test_in_a_run_and_in_another_thread_nothing_changes(kernel):
    kernel.run(TUTORIAL, "tutorial")
    assert kernel.run("from sim import run; run(main, seconds=20).ended.reason", "run").strip() == "'time'"
    code = f"""
import threading

class Fifth(MinimalPublisher):
    def timer_callback(self):
        super().timer_callback()
        if self.count == 5:  # after 2.5 s at the earliest
            rclpy.shutdown()

rclpy.init()
node = Fifth()
thread = threading.Thread(target=rclpy.spin, args=[node])
thread.start(); thread.join({PATIENCE})
thread.is_alive(), node.count
"""
    assert kernel.run(code, "thread").strip() == "(False, 5)"
