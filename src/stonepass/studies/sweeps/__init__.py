"""Sweeps over many cases: their plan, their blocks of work, the store of their results."""
