"""What every picture of a field starts from: which points, which strokes, from where."""
