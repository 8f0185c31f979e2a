"""Builds students' packages in a sandbox of their own, where programs can be started, and nothing reached."""
