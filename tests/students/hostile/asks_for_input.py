"""A question to someone who is not there."""

# %% after square
input("Points? ")
