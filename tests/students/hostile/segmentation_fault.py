"""The process crashes."""

# %% after square
import ctypes

ctypes.string_at(0)
