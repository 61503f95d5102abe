"""Finite-element states of one case: the seated state, the loaded state, and their solvers."""
