"""A question to somebody who is not there."""

# %% after square
input("Points? ")
