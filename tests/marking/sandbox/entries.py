"""What runs inside: an entry that does what the test says and sends back what came of it."""
import json
import socket


def obey(wire: socket.socket) -> None:
    """Run each message as Python code; answer with `answer` as JSON, or with the error's last line."""
    names: dict = {"wire": wire}
    while code := wire.recv(1 << 20):
        names["answer"] = None
        try:
            exec(code.decode(), names)
            answer = {"answer": names["answer"]}
        except Exception as error:
            answer = {"error": type(error).__name__, "text": str(error)}
        wire.sendall(json.dumps(answer).encode() + b"\n")


def greedy(wire: socket.socket) -> None:
    """Take memory until there is none."""
    held = []
    while True:
        held.append(bytearray(100_000))
