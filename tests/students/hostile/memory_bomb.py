"""All memory is asked for."""

# %% after square
hoard = [bytearray(100_000_000) for _ in range(1000)]
