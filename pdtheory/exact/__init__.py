"""The exact side."""
