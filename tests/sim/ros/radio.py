"""What Fast DDS does on a network that loses packets: `python -m tests.sim.ros.radio 0.2 reliable`.

Two processes, each with a network of its own; this one carries the packets between them, 20 ms late, and
loses such a share. Needs root and /dev/net/tun. Prints what the listener received: each number, and how late.
"""

import array
import ctypes
import fcntl
import heapq
import os
import random
import select
import socket
import struct
import subprocess
import sys
import time

QUIET, SPOKEN, DELAY, PERIOD, DEPTH = 5.0, 20.0, 0.02, 0.1, 50  # s, s, s, s, messages
NEW_NETWORK, TUN_WITHOUT_HEADER, SET_INTERFACE = 0x40000000, 0x1001, 0x400454CA


def end(number: int, reliability: str) -> None:
    """The speaker, 1, or the listener, 2."""
    os.environ |= {"ROS_DOMAIN_ID": "5", "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
    import rclpy
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos import QoSProfile, ReliabilityPolicy
    from std_msgs.msg import Float64MultiArray

    rclpy.init()
    node, begin, logged = Node(f"end_{number}"), time.time() + QUIET, []
    profile = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy[reliability.upper()])

    def on_message(msg: Float64MultiArray) -> None:
        logged.append(f"{msg.data[0]:.0f}:{time.time() - msg.data[1]:.2f}")

    events = SubscriptionEventCallbacks(
        message_lost=lambda event: logged.append(f"lost:{event.total_count_change}")
    )
    if number == 1:
        publisher, count = node.create_publisher(Float64MultiArray, "facts", profile), 0
    else:
        node.create_subscription(Float64MultiArray, "facts", on_message, profile, event_callbacks=events)
    while time.time() < begin + SPOKEN + 4:
        rclpy.spin_once(node, timeout_sec=0.002)
        if number == 1 and begin + count * PERIOD < time.time() < begin + SPOKEN:
            count += 1
            publisher.publish(Float64MultiArray(data=[float(count), time.time()]))
    print(*logged, flush=True)


def start(number: int, reliability: str) -> tuple[int, int]:
    """A process with a network of its own; gives its id, and a file of the packets that it sends and gets."""
    own, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
    child = os.fork()
    if child:
        _, files, _, _ = socket.recv_fds(own, 1, 1)
        return child, array.array("i", files)[0]
    if ctypes.CDLL(None).unshare(NEW_NETWORK):
        raise PermissionError("a network of one's own needs root")
    tun = os.open("/dev/net/tun", os.O_RDWR)
    fcntl.ioctl(tun, SET_INTERFACE, struct.pack("16sH", b"t0", TUN_WITHOUT_HEADER))
    for words in (
        "link set lo up", f"addr add 10.9.0.{number}/24 dev t0", "link set t0 up multicast on",
        "route add 224.0.0.0/4 dev t0",
    ):  # fmt: skip
        subprocess.run(["ip", *words.split()], check=True)
    socket.send_fds(other, [b"x"], [tun])
    os.execv(sys.executable, [sys.executable, "-m", "tests.sim.ros.radio", "end", str(number), reliability])


def carry(loss: float, reliability: str) -> None:
    """Carry packets between both until they end; none is lost while they get to know each other."""
    (first, one), (second, other) = start(1, reliability), start(2, reliability)
    alive, late, count, begin = {first, second}, [], 0, time.time()
    while alive:
        wait = max(0.0, min(0.05, late[0][0] - time.time())) if late else 0.05
        for tun in select.select([one, other], [], [], wait)[0]:
            packet = os.read(tun, 65536)
            if time.time() - begin < QUIET or random.random() >= loss:
                count += 1
                heapq.heappush(late, (time.time() + DELAY, count, other if tun == one else one, packet))
        while late and late[0][0] <= time.time():
            _, _, tun, packet = heapq.heappop(late)
            os.write(tun, packet)
        alive.discard(os.waitpid(-1, os.WNOHANG)[0])


if __name__ == "__main__":
    if sys.argv[1] == "end":
        end(int(sys.argv[2]), sys.argv[3])
    else:
        carry(float(sys.argv[1]), sys.argv[2])
