"""The course as files: its notebooks, their form, progress, the start page, and a student's copy."""
