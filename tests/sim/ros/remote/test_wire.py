"""The wire between two processes: its messages, and each of its errors."""

import socket
import struct
import threading

import msgpack
import pytest

from sim.ros.remote import Wire, WireBroken, WireClosed, WireTimeout
from tests.patience import PATIENCE


@pytest.fixture
def ends():
    near, far = socket.socketpair()
    with near, far:
        yield near, far


@pytest.fixture
def wires(ends):
    return Wire(ends[0]), Wire(ends[1])


def _endless() -> list:
    inside: list = []
    inside.append(inside)
    return inside


def framed(body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + body


def test_messages_arrive_complete_and_in_order(wires):
    near, far = wires
    near.send(do="go", now=1)
    near.send(text="Grüße, \ud800 and \0", numbers=[1, 0.1, None, True], big=2**63, raw=b"\xff")
    assert far.receive() == {"do": "go", "now": 1}
    assert far.receive(PATIENCE) == {
        "text": "Grüße, \ud800 and \0",
        "numbers": [1, 0.1, None, True],
        "big": 2**63,
        "raw": b"\xff",
    }


def test_a_message_may_be_longer_than_the_socket_buffers(wires):
    near, far = wires
    text = "x" * 5_000_000
    sender = threading.Thread(target=near.send, kwargs={"text": text})
    sender.start()
    assert far.receive(PATIENCE) == {"text": text}
    sender.join()


def test_a_closed_connection_raises_wire_closed(wires):
    near, far = wires
    near.send(last=1)
    near.close()
    assert far.receive() == {"last": 1}
    with pytest.raises(WireClosed, match=r"^the other process has closed the connection$"):
        far.receive()
    with pytest.raises(WireClosed, match=r"^the other process has closed the connection$"):
        far.send(anyone=1)
    with pytest.raises(WireClosed, match=r"^the other process has closed the connection$"):
        near.receive()


def test_an_incomplete_message_is_not_received(ends):
    ends[0].sendall(framed(b"\x81\xa1a\x01")[:-1])
    ends[0].close()
    with pytest.raises(WireClosed, match=r"^the other process has closed the connection$"):
        Wire(ends[1]).receive()


def test_receiving_times_out_and_can_be_continued(ends):
    far = Wire(ends[1])
    with pytest.raises(WireTimeout, match=r"^no complete message came for 0\.05 s$"):
        far.receive(0.05)
    ends[0].sendall(framed(b"\x81\xa1a\x01")[:6])
    with pytest.raises(WireTimeout, match=r"^no complete message came for 0\.05 s$"):
        far.receive(0.05)
    ends[0].sendall(framed(b"\x81\xa1a\x01")[6:])
    assert far.receive(PATIENCE) == {"a": 1}


def test_sending_times_out_if_the_other_process_does_not_receive(ends):
    with pytest.raises(WireTimeout, match=r"^the other process accepted no message for 0\.05 s$"):
        Wire(ends[0], patience=0.05).send(text="x" * 5_000_000)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (b"", "the received bytes are no message"),
        (b"\x81", "the received bytes are no message"),
        (b"\x81\xa1a\x01\x02", "the received bytes are no message"),
        (b"\xa1\xff", "the received bytes are no message"),
        (b"\xc1", "the received bytes are no message"),
        (b"\x91" * 100_000, "the received bytes are no message"),
        (b"\xdd\xff\xff\xff\xff", "the received bytes are no message"),
        (b"\xdf\xff\xff\xff\xff", "the received bytes are no message"),
        (b"\xc6\xff\xff\xff\xff", "the received bytes are no message"),
        (b"\x81\x90\x01", "the received bytes are no message"),
        (b"\x91\x01", "the received message is not a dictionary but a list"),
        (b"\xc0", "the received message is not a dictionary but a NoneType"),
    ],
)
def test_bytes_that_are_no_message_are_refused(ends, body, words):
    ends[0].sendall(framed(body))
    with pytest.raises(WireBroken, match=f"^{words}$"):
        Wire(ends[1]).receive(PATIENCE)


def test_a_message_that_is_too_long_is_refused_by_its_length(ends):
    ends[0].sendall(struct.pack(">I", 2**32 - 1))
    with pytest.raises(WireBroken, match=r"^a message of 4294967295 bytes is too long: 100 are allowed$"):
        Wire(ends[1], limit=100).receive(PATIENCE)


def test_a_message_that_is_too_long_is_not_sent(wires, ends):
    with pytest.raises(WireBroken, match=r"^a message of 105 bytes is too long: 100 are allowed$"):
        Wire(ends[0], limit=100).send(text="x" * 97)
    wires[0].send(all="well")
    assert wires[1].receive(PATIENCE) == {"all": "well"}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (object, "the message can't be sent: can not serialize 'type' object"),
        (2**64, "the message can't be sent: Integer value out of range"),
        (_endless(), "the message can't be sent: recursion limit exceeded."),
    ],
)
def test_only_plain_data_is_sent(wires, value, words):
    with pytest.raises(WireBroken, match=f"^{words}"):
        wires[0].send(value=value)
    wires[0].send(all="well")
    assert wires[1].receive(PATIENCE) == {"all": "well"}


def test_a_sent_message_is_messagepack_after_its_length(ends):
    Wire(ends[0]).send(a="ä")
    size = struct.unpack(">I", ends[1].recv(4))[0]
    assert msgpack.unpackb(ends[1].recv(size)) == {"a": "ä"}
