"""The judge is offered nodes in a cell that has no test, and again and again."""

# %% after square
import gc

wire = next(thing for thing in gc.get_objects() if type(thing).__name__ == "Wire")
for number in range(100_000):
    wire.send(grade=f"square {number}")
