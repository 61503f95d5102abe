"""Surrogates: the critical pressure as polynomials of the inputs, with a measured error."""
