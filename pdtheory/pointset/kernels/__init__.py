"""The compiled part of the engine: what happens at one point, and chunks of points."""
