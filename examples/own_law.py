"""A wall of one's own: a strain energy in plain arithmetic, used in both halves of the model.

stonepass pressure --xi 1.2 --eta 1.3 --material examples/own_law.py:energy
"""

source = "an example, not a measured tissue"
strain_range = (1.0, 1.4)

MU, STIFFENING = 60e3, 2.0  # Pa, –


def energy(C_rr, C_tt, C_zz, C_rz, xp):
    """Exponential isotropic law (Demiray), in J/m³; xp is the array namespace."""
    I1 = C_rr + C_tt + C_zz
    return MU / (2.0 * STIFFENING) * (xp.exp(STIFFENING * (I1 - 3.0)) - 1.0)
