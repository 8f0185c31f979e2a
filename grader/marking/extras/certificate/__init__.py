"""Certificates: a page of what a student passed, and the receipt with which the instructor confirms it."""
