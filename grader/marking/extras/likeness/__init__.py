"""python -m grader likeness: which submissions of an assignment are alike, for a person to look at."""
