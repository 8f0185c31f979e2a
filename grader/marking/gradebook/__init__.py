"""A class as nbgrader keeps it: its folders, its gradebook, its notebooks and pages."""
