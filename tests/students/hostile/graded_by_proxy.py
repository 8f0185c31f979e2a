"""The test cell's exercise gets another, easier one."""

# %% after square
topics.square = topics.temperature
SquareDriver = Thermometer
