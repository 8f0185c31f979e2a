"""The process that belongs to a student: it runs the cells of a notebook, and nobody trusts it."""
