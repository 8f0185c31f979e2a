"""Builds students' packages in a sandbox of their own, in which programs can be started."""
