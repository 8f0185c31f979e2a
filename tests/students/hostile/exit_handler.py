"""Something is left to be done when the process ends."""

# %% after square
import atexit
import os

atexit.register(lambda: os.write(1, b"18.0"))
