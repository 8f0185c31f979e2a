"""Files of Moodle and Canvas: grades filled in, archives of submissions collected, feedback packed."""
