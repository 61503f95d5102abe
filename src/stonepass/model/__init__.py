"""The physics of one case: stone, ureter and load, far field, models, and critical pressure."""
