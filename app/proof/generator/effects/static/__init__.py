"""What moves a tool point away from where the description says: one file an effect, each with `EFFECT`."""
