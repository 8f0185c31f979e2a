"""The worlds with mobile robots; the others hold a machine."""

from sim.world import World

MOBILE = [name for name in World.names() if World.load(name).machine is None]
