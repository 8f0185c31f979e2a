"""The untrusted process of a student, which runs the cells of a notebook."""
