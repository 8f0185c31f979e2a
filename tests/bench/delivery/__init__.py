"""A delivery robot for generated warehouses, in three programs: each knows its own task only."""
