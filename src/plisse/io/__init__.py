"""Files: one format per module, reading and writing side by side."""
