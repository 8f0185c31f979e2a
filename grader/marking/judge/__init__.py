"""The judge: leads a student's process through a notebook, and judges what it hands over."""
