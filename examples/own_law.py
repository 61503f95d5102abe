"""Your own wall: a strain energy in plain arithmetic, used for the far field and the contact.

stonepass pressure --xi 1.2 --eta 1.3 --material examples/own_law.py:energy
"""

source = "an example, not a measured tissue"
strain_range = (1.0, 1.4)

MU, STIFFENING = 60e3, 2.0  # Pa, –


def energy(C, place, xp):
    """Exponential isotropic law (Demiray), in J/m³.

    C has the right Cauchy–Green components C.rr, C.tt, C.zz, C.rz, C.rt, C.tz and the invariants
    C.I1, C.I2, C.I3; place has the reference coordinates place.R and place.Z in inner radii; xp is
    the array namespace.
    """
    return MU / (2.0 * STIFFENING) * (xp.exp(STIFFENING * (C.I1 - 3.0)) - 1.0)
