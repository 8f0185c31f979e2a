"""The search for an order in which a run's nodes fail."""

from sim.ros.exploring.explore import explore
from sim.ros.exploring.explored import Explored

__all__ = ["Explored", "explore"]
