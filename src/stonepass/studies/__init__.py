"""Many cases: curves and, later, sweeps, populations and sensitivities."""
