"""The test cell's exercise is told that another, easier one was asked for."""

# %% after square
topics.square = topics.temperature
SquareDriver = Thermometer
