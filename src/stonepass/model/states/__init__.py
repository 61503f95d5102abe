"""Finite-element states of one case: seated, loaded, and who solves them."""
