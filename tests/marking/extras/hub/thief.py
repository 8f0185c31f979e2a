"""Runs in the kernel of one student of a hub, and tries to reach what belongs to others: prints what happened.

PLACES is a list of (kind, path) that the thief was given; without that, paths would have to be guessed. Nothing of
this may work: each line of the answer is "kind: attempt: how it ended".
"""
import glob
import os
import socket
import ssl
import time
import urllib.request

import zmq

PLACES, PORTS, PROCESSES = [], [], []  # replaced by the test
ME = os.getuid()


def attempt(kind, name, action):
    """Print how an action ended."""
    try:
        result = action()
    except PermissionError:
        print(f"{kind}: {name}: denied")
    except Exception as error:
        print(f"{kind}: {name}: {type(error).__name__}")
    else:
        print(f"{kind}: {name}: DONE {str(result)[:100]!r}")


def append(path):
    """Change a file."""
    with open(path, "a") as file:
        file.write("x")


def replace(path):
    """Put an own file in the place of another."""
    with open("/tmp/mine", "w") as file:
        file.write("x")
    os.replace("/tmp/mine", path)


def link(path):
    """Read through a link."""
    name = os.path.expanduser("~/link")
    if os.path.lexists(name):
        os.remove(name)
    os.symlink(path, name)
    return open(name).read(10)


def hard_link(path):
    """Keep a second name of a file."""
    os.link(path, os.path.expanduser("~/second-name"))


def connect(path):
    """Connect with a kernel's socket."""
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(path)


for kind, path in PLACES:
    attempt(kind, "list", lambda path=path: os.listdir(os.path.dirname(path)))
    attempt(kind, "read", lambda path=path: open(path).read(10))
    attempt(kind, "append", lambda path=path: append(path))
    attempt(kind, "replace", lambda path=path: replace(path))
    attempt(kind, "delete", lambda path=path: os.remove(path))
    attempt(kind, "symlink", lambda path=path: link(path))
    attempt(kind, "hard link", lambda path=path: hard_link(path))
    attempt(kind, "add", lambda path=path: append(os.path.join(os.path.dirname(path), "added")))
    attempt(kind, "connect", lambda path=path: connect(path))

for port in PORTS:
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    address = f"https://127.0.0.1:{port}/"
    attempt("port", "https", lambda: urllib.request.urlopen(address, context=context, timeout=20).status)
    attempt("port", "http", lambda: urllib.request.urlopen(address.replace("s:", ":", 1), timeout=20).status)

for process in PROCESSES:
    attempt("process", "environment", lambda: open(f"/proc/{process}/environ").read())
    attempt("process", "command", lambda: open(f"/proc/{process}/cmdline").read())
    attempt("process", "kill", lambda: os.kill(process, 9))
listed = [path for path in glob.glob("/proc/[0-9]*") if os.stat(path).st_uid != ME]
print(f"process: list: {'DONE' if listed else 'only the own ones'} {listed[:3]}")

# A kernel that listened on a port would send its outputs to every subscriber.
context, sockets = zmq.Context(), []
for port in PORTS:
    for kind in (zmq.SUB, zmq.PULL):
        sockets.append(context.socket(kind))
        sockets[-1].connect(f"tcp://127.0.0.1:{port}")
    sockets[-2].subscribe(b"")
end = time.monotonic() + 5
while time.monotonic() < end:
    for each in sockets:
        if each.poll(10):
            print(f"kernel: listen: DONE {each.recv_multipart()!r}")
context.destroy(0)
for path in glob.glob("/tmp/*") + glob.glob("/var/tmp/*") + glob.glob("/dev/shm/*"):
    if os.lstat(path).st_uid != ME:
        print(f"temporary: {path}: DONE")
