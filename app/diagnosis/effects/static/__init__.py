"""Effects seen in where a tool point is."""
