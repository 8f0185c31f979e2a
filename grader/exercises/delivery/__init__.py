"""The exercises of 13_delivery, the delivery robot: from the graph on paper to one that drives."""

from grader.checks import questions
from grader.companions.blind_drivers import turner
from grader.companions.faulty_perception import partners
from grader.companions.map_messages import KEPT, flat, listed, seconds, stamped
from grader.companions.parcel_database import scanner
from grader.companions.parcel_library import shelf_of
from grader.companions.planned_nodes import ShelfCamera, publishes, sketch, subscribes
from grader.companions.robot_programs import programs, shift_of
from grader.companions.scripted_orders import desk
from grader.exercises.delivery.blueprint import blueprint
from grader.exercises.delivery.decide import decide
from grader.exercises.delivery.deliver import deliver
from grader.exercises.delivery.gate import gate
from grader.exercises.delivery.perceive import perceive
from grader.exercises.delivery.shelves import shelves
from grader.geometry.floor import Floor, far_from, points_of, steer
from grader.worlds.crossing import crossing
from grader.worlds.warehouses import floor_of, hall, warehouse
