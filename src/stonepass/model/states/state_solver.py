"""The interface by which models and studies obtain finite-element states, solved or cached."""

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

    `model.states.uncached.UNCACHED` solves a state at each call;
    `studies.solution_cache.SolutionCache` stores states on disk. Every implementation satisfies the
    following conditions.

    * A method returns the same numbers, bit for bit, as the function named in its docstring returns
      for the same arguments, however often and in whatever order it is called.
    * The returned state refers to the case that was passed, with the lengths and moduli of this
      case.
    * The stress field of a state, its attribute `wall`, may be None. A caller that needs the field
      must use an implementation that keeps it.
    * A state that is not found is reported by a return value (`NoSeat`, `NoPush` or None), and not
      by an exception.
    * An instance is immutable. It can be pickled and used in another process.
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
            The way in which the stone is brought into the wall.
        numerics : Numerics
        resolution : Resolution, optional
            Resolution of a single solve; by default both resolutions of the accuracy level are
            solved, and the error is estimated from the difference.
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
            Coarse resolutions first; the result has one element for each.
        wetted : bool
            True if urine enters the contact up to the seal, see `PushThrough`.
        leak : bool
            True to determine the leak pressure as well, with the first resolution.
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
            Urine pressures in Pa, zero or positive. Each state is the starting point of the next
            one, and the result has one element for each pressure.
        resolution : Resolution
        wetted : bool
            True if urine enters the contact up to the seal, see `PushThrough`.
        """

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """Return angles and radii of the opening wall; see `model.states.opening`."""
