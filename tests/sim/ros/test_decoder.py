"""Bytes are decoded into the very objects that rclpy makes of them, whatever the bytes are."""

import random

import numpy as np
import pytest
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy

from sim.ros.messages.codec import encode, message_class
from sim.ros.messages.decoder import decode_message
from tests.sim.ros.test_cdr import TYPES, filled

ROUNDS = 10


def plain(value):
    """All that a value is made of, with the types of its parts."""
    if hasattr(value, "SLOT_TYPES"):
        return type(value), [plain(getattr(value, slot)) for slot in value.__slots__]
    if isinstance(value, list):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray):
        return value.dtype, value.shape, value.tobytes(), value.flags.writeable
    return type(value), repr(value)  # not the value: nan is not nan


def found(decode, cls, raw):
    """What a decoder makes of bytes; None for bytes that are no message."""
    try:
        return plain(decode(cls, raw))
    except _rclpy.RMWError:
        return None


def by_rclpy(cls, raw):
    return _rclpy.rclpy_deserialize(raw, cls)


@pytest.mark.parametrize("name", TYPES)
def test_a_message_is_what_rclpy_makes_of_its_bytes(name):
    cls, chance = message_class(name), random.Random(name)
    for _ in range(ROUNDS):
        raw = encode(filled(chance, cls))
        assert plain(decode_message(cls, raw)) == plain(by_rclpy(cls, raw))


@pytest.mark.parametrize("name", TYPES)
def test_damaged_bytes_are_what_they_are_to_rclpy(name):
    cls, chance = message_class(name), random.Random(f"damaged {name}")
    for _ in range(ROUNDS):
        raw = encode(filled(chance, cls))
        short = raw[: chance.randrange(len(raw))]
        other = bytearray(raw)
        for _ in range(3):
            other[chance.randrange(len(raw))] = chance.randrange(256)
        for damaged in (short, bytes(other), raw + b"more"):
            assert found(decode_message, cls, damaged) == found(by_rclpy, cls, damaged)
