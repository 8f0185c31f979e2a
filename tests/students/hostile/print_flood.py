"""Output without end."""

# %% after square
while True:
    print("x" * 1_000_000)
