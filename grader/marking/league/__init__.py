"""`python -m grader league`: capstones in the same warehouses, compared."""
