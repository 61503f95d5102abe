"""Finite elements: an axisymmetric, incompressible tube wall round a rigid profile.

Mathematics only: this layer works without units (lengths in inner radii, stresses in a modulus
of the law) and has never heard of a stone or a ureter.
"""
