"""The filter on system calls that every confined process has: a BPF program for x86_64.

A call that is denied fails with EPERM, so student code gets an ordinary PermissionError. Threads are allowed,
processes are not, unless it may start programs. Nothing is allowed that outlives the confined process or is
shared with another one.
"""

import errno
import struct

X86_64 = 0xC000003E
_X32 = 0x40000000  # calls of the x32 ABI have this bit
_CLONE_THREAD = 0x10000
_CLONE_NEW = 0x7E020000  # any of the namespaces
_AF_UNIX, _AF_INET, _AF_NETLINK, _NETLINK_ROUTE = 1, 2, 16, 0

_SOCK_DGRAM, _SOCK_TYPE = 2, 0xF

_CLONE, _CLONE3, _SOCKET, _SOCKETPAIR = 56, 435, 41, 53

PROGRAMS = {"fork": 57, "vfork": 58, "execve": 59, "execveat": 322}  # new processes and programs
DENIED = {
    # other processes
    "ptrace": 101, "process_vm_readv": 310, "process_vm_writev": 311, "process_madvise": 440, "kcmp": 312,
    "pidfd_open": 434, "pidfd_getfd": 438,
    # memory and messages that remain after the confined process has ended, or that no limit counts
    "shmget": 29, "shmat": 30, "shmctl": 31, "semget": 64, "msgget": 68, "mq_open": 240,
    "memfd_create": 319, "memfd_secret": 447,
    "inotify_init": 253, "inotify_init1": 294,  # a user has 128 of them, on the whole machine
    "add_key": 248, "request_key": 249, "keyctl": 250,
    # other files and mounts
    "mount": 165, "umount2": 166, "pivot_root": 155, "chroot": 161, "open_tree": 428, "move_mount": 429,
    "fsopen": 430, "fsconfig": 431, "fsmount": 432, "fspick": 433, "mount_setattr": 442,
    "open_tree_attr": 467, "unshare": 272, "setns": 308, "name_to_handle_at": 303, "open_by_handle_at": 304,
    "fanotify_init": 300, "mknod": 133, "mknodat": 259,
    # ways into the kernel that a course on robots does not need
    "bpf": 321, "perf_event_open": 298, "userfaultfd": 323, "io_uring_setup": 425, "io_uring_enter": 426,
    "io_uring_register": 427, "modify_ldt": 154, "personality": 135, "lookup_dcookie": 212, "vmsplice": 278,
    # the machine
    "kexec_load": 246, "kexec_file_load": 320, "create_module": 174, "init_module": 175, "delete_module": 176,
    "finit_module": 313, "iopl": 172, "ioperm": 173, "swapon": 167, "swapoff": 168, "reboot": 169,
    "sethostname": 170, "setdomainname": 171, "settimeofday": 164, "clock_settime": 227, "clock_adjtime": 305,
    "adjtimex": 159, "acct": 163, "quotactl": 179, "quotactl_fd": 443, "syslog": 103, "vhangup": 153,
}  # fmt: skip

# Where there is no network namespace: nothing that reaches another process's socket.
NETWORK = {"socket": _SOCKET, "connect": 42, "bind": 49, "listen": 50, "accept": 43, "accept4": 288}

_AND = 0x54
_LOAD, _EQUAL, _AT_LEAST, _HAS, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_NUMBER, _ARCHITECTURE, _ARGUMENTS = 0, 4, 16  # offsets in struct seccomp_data


def _step(code: int, value: int, then: int = 0, otherwise: int = 0) -> bytes:
    """Return an instruction; `then` and `otherwise`: how many instructions a comparison skips."""
    return struct.pack("=HBBI", code, then, otherwise, value)


def _argument(index: int) -> bytes:
    return _step(_LOAD, _ARGUMENTS + 8 * index)  # its lower half


_ALLOW = _step(_RETURN, 0x7FFF0000)
_DENY = _step(_RETURN, 0x00050000 | errno.EPERM)
_UNKNOWN = _step(_RETURN, 0x00050000 | errno.ENOSYS)


def _rule(number: int, *steps: bytes) -> bytes:
    """Return steps that decide on the call `number` and are skipped for every other call."""
    return _step(_EQUAL, number, 0, len(steps)) + b"".join(steps)


def _no_sockets() -> list[bytes]:
    """Deny sockets. From one of a pair of datagrams, messages could be sent to any other Unix socket."""
    kind = _argument(1) + _step(_AND, _SOCK_TYPE)
    pairs = _step(_EQUAL, _SOCKETPAIR, 0, 5) + kind + _step(_EQUAL, _SOCK_DGRAM, 0, 1) + _DENY + _ALLOW
    return [pairs, *(_rule(number, _DENY) for number in NETWORK.values())]


def program(programs: bool = False, sockets: bool = True) -> bytes:
    """Return the filter as BPF instructions of 8 bytes.

    programs: whether it allows starting programs. sockets: whether it allows any but connected pairs.
    """
    denied = DENIED if programs else PROGRAMS | DENIED
    new, others = (_CLONE_NEW, (0, 1)) if programs else (_CLONE_THREAD, (1, 0))
    steps = [
        _step(_LOAD, _ARCHITECTURE),
        _step(_EQUAL, X86_64, 1, 0),
        _DENY,
        _step(_LOAD, _NUMBER),
        _step(_AT_LEAST, _X32, 0, 1),
        _DENY,
        # clone3 has its flags in memory, which no filter can read: glibc falls back to clone.
        _rule(_CLONE3, _UNKNOWN),
        _rule(_CLONE, _argument(0), _step(_HAS, new, *others), _DENY, _ALLOW),
        *([] if sockets else _no_sockets()),
        # Fast DDS opens UDP sockets, and netlink to list the interfaces; nothing is reachable through them.
        # Other families, such as sockets to the host of a virtual machine, belong to no network namespace.
        _rule(
            _SOCKET,
            _argument(0),
            _step(_EQUAL, _AF_UNIX, 5, 0),
            _step(_EQUAL, _AF_INET, 4, 0),
            _step(_EQUAL, _AF_NETLINK, 0, 2),
            _argument(2),
            _step(_EQUAL, _NETLINK_ROUTE, 1, 0),
            _DENY,
            _ALLOW,
        ),
        *(_rule(number, _DENY) for number in denied.values()),
        _ALLOW,
    ]
    return b"".join(steps)
