"""python -m grader variants: each student's own notebooks of an assignment with variants."""
