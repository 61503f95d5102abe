"""Seeds of random numbers."""

from __future__ import annotations

from stonepass.errors import require

__all__ = ["check_seed"]

LARGEST_SEED = 2**32 - 2  # a sensitivity study needs the next seed too; both have 32 bits


def check_seed(seed: object, name: str = "seed") -> None:
    """Raise BadInput if a seed is no whole number or out of bounds.

    Parameters
    ----------
    seed : object
    name : str
        Name of the input in messages.
    """
    whole = isinstance(seed, int) and not isinstance(seed, bool) and 0 <= seed <= LARGEST_SEED
    require(whole, name, seed, f"a whole number from 0 to {LARGEST_SEED}")
