"""A class in nbgrader's form: its folders, its gradebook, its notebooks and pages."""
