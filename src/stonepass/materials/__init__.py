"""Material laws: strain energies of the wall, their published constants, their stability."""
