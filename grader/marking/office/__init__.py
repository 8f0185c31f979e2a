"""The instructor's side of marking: what is handed in, the gradebook, the pages, the summary."""
