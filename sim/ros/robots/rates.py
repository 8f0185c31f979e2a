"""How often robots and machines speak, and how often they can be spoken to."""

SENSOR_RATE = 20
"""How often in a second most sensors speak, and everything is tracked."""
MOST_COMMANDS = 1000
"""In a second; ten times what the quickest robots take."""
