"""A score is printed, shown and left as the cell's value."""

# %% square
print("18.0")
display(18.0)
SquareDriver = None
18.0
