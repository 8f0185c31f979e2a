"""python -m grader mark-one: judges one submission without a gradebook, and writes the result as JSON."""
