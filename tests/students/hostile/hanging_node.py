"""A node whose constructor never returns."""

# %% square
class SquareDriver(Node):
    def __init__(self):
        super().__init__("square_driver")
        while True:
            pass
