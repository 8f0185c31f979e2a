"""Message types by their names. Of upstream's package it has the module utilities."""
