"""Laws for tests of sweeps, in a module of its own, which worker processes can import."""

import multiprocessing
import os
from dataclasses import dataclass
from pathlib import Path

import stonepass as sp
from stonepass.materials.constants import check_constants, constant


@dataclass(frozen=True)
class Hazard:
    """Rubber whose energy fails, or ends the process, where a constant says so."""

    C10: float = constant("C10", "Pa", "modulus")
    hazard: float = constant(
        "h", "1", "0 none, 1 an error, 2 the end of the process", low=0.0, high=2.0,
        low_allowed=True, high_allowed=True, default=0.0,
    )  # fmt: skip
    deaths: str = ""  # a file with one letter for each process that ended

    def __post_init__(self):
        check_constants(self)

    def energy(self, C, place, xp):
        if self.hazard == 1.0:
            raise ArithmeticError("the law failed")
        if self.hazard == 2.0 and multiprocessing.parent_process() is not None:
            with Path(self.deaths).open("a", encoding="utf-8") as file:
                file.write("x")
            os._exit(9)
        return self.C10 * (C.I1 - 3.0)


def hazardous(deaths=""):
    return sp.Material("toy", Hazard(0.1e6, deaths=str(deaths)), "a test", "none", "no", (1.0, 2.0))
