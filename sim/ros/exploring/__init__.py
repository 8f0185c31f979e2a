"""The search for an order in which a run's nodes fail."""

from sim.ros.exploring.by_hand import schedule
from sim.ros.exploring.consequences import consequences
from sim.ros.exploring.explore import explore, stopping_at_the_first
from sim.ros.exploring.explored import Explored, list_departures
from sim.ros.exploring.shrink import shrink

__all__ = [
    "Explored",
    "consequences",
    "explore",
    "list_departures",
    "schedule",
    "shrink",
    "stopping_at_the_first",
]
