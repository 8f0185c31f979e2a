"""Everything in a run happens on one thread, in one order: fibers, their scheduler, and locks for them."""
