"""A loop that swallows every interrupt."""

# %% after square
while True:
    try:
        while True:
            pass
    except BaseException:
        pass
