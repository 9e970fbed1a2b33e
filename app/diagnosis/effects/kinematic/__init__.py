"""Effects seen in where a tool point is: one file each."""
