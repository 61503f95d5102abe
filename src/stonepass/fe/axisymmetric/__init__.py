"""Axisymmetric finite elements: seated contact, sliding contact, post-processing."""
