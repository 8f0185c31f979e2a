"""`python -m grader league`: compares capstones in the same warehouses."""
