"""Everything in a run happens on one thread, in one order: fibers, who goes on when, locks between them."""
