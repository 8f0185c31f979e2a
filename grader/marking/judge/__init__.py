"""The judge: runs a notebook cell by cell in a student's process, and judges the nodes that it hands over."""
