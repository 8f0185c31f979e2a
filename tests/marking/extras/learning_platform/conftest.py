"""The class of the gradebook's fixtures, and files as the platforms export them."""
from tests.marking.marked_class import course, marked_template, say  # noqa: F401
