"""The paper, recomputed: its statements and its figures."""
