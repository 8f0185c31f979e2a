"""python -m grader platform: autograders for Gradescope, Classroom 50 and PrairieLearn, from mark-one."""
