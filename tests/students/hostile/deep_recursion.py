"""C code that recurs without end."""

# %% after square
nested = []
for _ in range(1_000_000):
    nested = [nested]
del nested
import sys

sys.setrecursionlimit(10**6)


def deeper(depth):
    return deeper(depth + 1) + 1


deeper(0)
