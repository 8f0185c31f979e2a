"""The worlds of exercises, drawn from a seed. A world without a seed is a file in sim/world/worlds."""
