"""Finite elements: an incompressible tube wall in contact with a rigid body, the stone.

All quantities in this package are dimensionless: lengths are divided by the undeformed inner radius
of the tube, and stresses by one modulus of the wall law. The package `model` chooses that modulus:
it is the hoop modulus w″(1). In the docstrings "inner radius" and "the modulus" mean these two
scales. The wall law enters as a function that returns the energy density; this package does not
import materials, units or anything about patients.
"""
