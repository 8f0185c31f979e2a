"""Optional packages: the core of marking imports none of them at import time."""
