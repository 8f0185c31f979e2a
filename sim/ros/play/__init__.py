"""A run to watch and to drive: paced to the clock on the wall, with a picture."""
