"""The figures of the paper, drawn again from data, each with a check of numbers."""
