"""Seeds of random numbers, declared once for all doors."""

from __future__ import annotations

from stonepass.declaration import Kind, free_input, read_declared

__all__ = ["SEED", "check_seed"]

LARGEST_SEED = 2**32 - 2  # a sensitivity study needs the next seed too; both have 32 bits
SEED = free_input(
    "seed", Kind.WHOLE, "--seed", "Seed of the samples.", default=1, bounds=(0, LARGEST_SEED)
)


def check_seed(seed: object, name: str = "seed") -> None:
    """Raise BadInput if a seed is no whole number or out of bounds.

    Parameters
    ----------
    seed : object
    name : str
        Name of the input in messages.
    """
    read_declared(SEED.declaration, name, seed)
