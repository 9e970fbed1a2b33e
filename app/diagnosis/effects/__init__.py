"""The library of physics: one file an effect, found by its folder. A new file is a new effect."""
