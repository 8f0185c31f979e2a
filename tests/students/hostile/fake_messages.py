"""Messages are written into the recorder; no node sends them."""

# %% temperature
import gc

from sim.evidence import Message, Recording


class Thermometer(Node):
    def __init__(self):
        super().__init__("thermometer")
        self.create_timer(1.0, self.forge)

    def forge(self):
        for recording in [o for o in gc.get_objects() if isinstance(o, Recording)]:
            type_ = "std_msgs/msg/Float32"
            raw = b"\x00\x01\x00\x00\x00\x00\xb8\x41"
            recording.published[:] = [
                Message(float(t), "/sensor/temperature", type_, "/thermometer", raw) for t in range(1, 11)
            ]
