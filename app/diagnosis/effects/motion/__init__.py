"""Effects seen in joint torques over time."""
