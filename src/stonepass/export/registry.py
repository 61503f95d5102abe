"""The registered export formats in the order in which the help lists them."""

from __future__ import annotations

from stonepass.export.contract import Writer
from stonepass.export.writers.feb import FEB
from stonepass.export.writers.inp import INP
from stonepass.export.writers.vtu import VTU

__all__ = ["WRITERS"]

WRITERS: tuple[Writer, ...] = (INP, FEB, VTU)
