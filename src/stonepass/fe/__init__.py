"""Finite elements: an incompressible tube wall in contact with a rigid body, the stone.

This package works without units: lengths are in undeformed inner radii of the tube, stresses in
units of one modulus of the wall law (`model` chooses the hoop modulus w″(1)). It takes the law as
an energy function and knows nothing of materials, patients or units.
"""
