"""The filter on system calls, call by call."""
import errno

import pytest

from grader.marking.sandbox import seccomp

CALL = """
import ctypes
libc = ctypes.CDLL(None, use_errno=True)
def call(number, *arguments):
    ctypes.set_errno(0)
    result = libc.syscall(number, *map(ctypes.c_ulong, arguments))
    return ctypes.get_errno() if result == -1 else 0
"""


@pytest.fixture
def caller(commanded):
    commanded.ask(CALL)
    return commanded


def test_every_call_on_the_list_is_denied(caller):
    denied = seccomp.PROGRAMS | seccomp.DENIED
    answer = caller.ask(f"answer = {{name: call(number) for name, number in {denied}.items()}}")
    assert answer == dict.fromkeys(denied, errno.EPERM)


def test_clone_makes_threads_only_and_clone3_is_unknown(caller):
    vm_and_vfork = 0x4100
    assert caller.ask(f"answer = [call(56, 17), call(56, {vm_and_vfork}), call(435)]") == [
        errno.EPERM, errno.EPERM, errno.ENOSYS,
    ]  # fmt: skip


def test_calls_of_another_abi_are_denied(caller):
    getpid = 39
    assert caller.ask(f"answer = [call({getpid}), call({0x40000000 + getpid})]") == [0, errno.EPERM]


def test_sockets_are_unix_udp_tcp_and_the_list_of_interfaces(caller):
    datagram = 2
    allowed = f"answer = [family for family in range(50) if call(41, family, {datagram}, 0) != 1]"
    unix, inet, netlink = 1, 2, 16
    assert caller.ask(allowed) == [unix, inet, netlink]
    of_netlink = f"answer = [kind for kind in range(23) if call(41, {netlink}, {datagram}, kind) != 1]"
    route = 0
    assert caller.ask(of_netlink) == [route]
