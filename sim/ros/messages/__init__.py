"""Messages as bytes: encoded, decoded, and brought into one canonical form."""
