"""Forward models of an arm: exact prediction, and linear columns of everything that can differ."""
