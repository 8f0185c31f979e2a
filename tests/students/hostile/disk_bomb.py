"""Files without end."""

# %% after square
for number in range(1000):
    with open(f"/tmp/{number}", "wb") as file:
        file.write(bytes(100_000_000))
