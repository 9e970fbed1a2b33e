"""What a joint torque holds beyond rigid bodies: one file an effect, each with `EFFECT`."""
