"""Certificates: a page of what a student passed, and the receipt by which the instructor confirms it."""
