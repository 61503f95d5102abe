"""Material laws: strain energies of the wall, published constants, and stability checks."""
