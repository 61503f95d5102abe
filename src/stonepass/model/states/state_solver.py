"""The interface through which models and studies ask for finite-element states of one case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.units import Pressure

__all__ = ["StateSolver"]


@runtime_checkable
class StateSolver(Protocol):
    """A source of finite-element states.

    `model.states.uncached.UNCACHED` solves each state when it is asked for;
    `studies.solution_cache.SolutionCache` remembers states on disk. Every implementation promises
    the following.

    * A method returns the numbers that the function named in its docstring returns for the same
      arguments, equal to the last bit, no matter how often or in which order it is called.
    * The states that it returns carry the case that was passed, with its own lengths and moduli.
    * The stress field of a state (its attribute `wall`) may be None; a caller that needs the field
      must ask an implementation that keeps it.
    * A state that cannot be found is a value (`NoSeat`, `NoPush`, None), not an exception.
    * An instance holds nothing that changes, and can be pickled and used in another process.
    """

    def seat(
        self,
        case: Problem,
        seating: Seating,
        numerics: Numerics,
        resolution: Resolution | None = None,
    ) -> SeatedState | NoSeat:
        """Return the seated state without urine pressure; see `model.states.seated.solve_seated`.

        Parameters
        ----------
        case : Problem
        seating : Seating
            The way of the stone into the wall.
        numerics : Numerics
        resolution : Resolution, optional
            Mesh; by default both meshes of the accuracy, from which the error is estimated.
        """

    def push(
        self,
        case: Problem,
        numerics: Numerics,
        resolutions: Sequence[Resolution],
        *,
        wetted: bool,
        leak: bool,
    ) -> list[Critical | NoPush]:
        """Return the state in which the stone moves; see `model.states.loaded.find_critical`.

        Parameters
        ----------
        case : Problem
        numerics : Numerics
        resolutions : sequence of Resolution
            Meshes, coarse ones first; the result has one element for each.
        wetted : bool
            Whether urine takes its pressure off the friction up to the seal.
        leak : bool
            Whether the leak pressure is sought too, on the first mesh.
        """

    def hold(
        self,
        case: Problem,
        numerics: Numerics,
        pressures: Sequence[Pressure],
        resolution: Resolution,
        *,
        wetted: bool,
    ) -> list[PushedState | NoPush]:
        """Return states of a held stone; see `model.states.loaded.solve_loaded`.

        Parameters
        ----------
        case : Problem
        numerics : Numerics
        pressures : sequence of Pressure
            Urine pressures in Pa, each at least 0; each state is the start of the next one, and
            the result has one element for each pressure.
        resolution : Resolution
            Mesh.
        wetted : bool
            Whether urine takes its pressure off the friction up to the seal.
        """

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """Return α and r_a/R_a under rising pressure; see `model.states.opening`."""
