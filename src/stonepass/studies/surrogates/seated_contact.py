"""Surrogate of the paper's model: the seated contact is learnt, and the force balance is solved.

Width, size and shape of the contact pressure are smooth functions of the inputs everywhere in the
box. The critical pressure is not: its derivative jumps where the stone starts to move at the
contact angle, and it ceases to exist where the closure ends. Therefore the surrogate learns the
contact and solves the same balance of resistance and drive as the model (Eqs 3 to 17).

With ψ = π/2 − θ, the half-width w = π/2 − α₀ of the contact and the contact pressure σ, these are

* S = ∫ σ cos² ψ dψ and B = ∫ σ sin 2ψ dψ over half the contact, 0 ≤ ψ ≤ w, and
* the shapes s(x) and b(x) of these integrals up to ψ = w sin(πx/2), divided by S and B.

The seated contact is symmetric, so that F_f = 2μ S (1 + s) and F_σ = B (1 − b), each divided by
π R_s².
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebval

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.materials.protocol import Law
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.far_field import confining_traction, far_field_law, inflation
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.monotone import monotone_integral
from stonepass.model.states.seated_state import Contact, SeatedState
from stonepass.studies.surrogates.box import Setting, opening_pressure
from stonepass.studies.surrogates.crossing import (
    ALL,
    STEPS,
    Excess,
    Rows,
    first_crossing,
    refined_guess,
)
from stonepass.studies.surrogates.solved import BEYOND_CLOSURE, MOVES, Solved

__all__ = ["SeatedContact"]

POINTS = 14  # number of Chebyshev points at which the shapes are sampled
MODES = 5  # number of modes of each shape

# Chebyshev points of x between 0 and 1, and the matrix that turns values there into coefficients.
_X = (1.0 + np.cos(np.pi * (np.arange(POINTS) + 0.5) / POINTS)) / 2.0
_TO_COEFFICIENTS = np.linalg.inv(chebval(2.0 * _X - 1.0, np.eye(POINTS)).T)


@array_dataclass
@dataclass(frozen=True)
class SeatedContact:
    """The shapes of the seated contact, and the balance that gives the critical pressure.

    The learnt functions are ln(w/root), ln(S/P_s), ln(B/(w S)), the amplitudes of the modes of both
    shapes, and a first guess of the place x at which the stone moves. `root` is the coordinate of
    the size, and P_s is the pressure that opens the tube to the width of the stone; with these
    scales the functions are bounded for small stones.

    Attributes
    ----------
    shear, axial : array (1 + modes, points)
        Chebyshev coefficients in 2x − 1 of the mean shape and of its modes, for s and for b.
    """

    shear: Float[np.ndarray, "modes points"]
    axial: Float[np.ndarray, "modes points"]

    @classmethod
    def fitted_to(cls, answers: Sequence[Answer | None]) -> SeatedContact:
        """Return the mean shapes and the largest modes of the answers that have a contact."""
        seated = [each for each in map(_contact, answers) if each is not None]
        known = [_integrals(each) for each in seated]
        return cls(_modes(np.array([each.s for each in known])),
                   _modes(np.array([each.b for each in known])))  # fmt: skip

    def learnt(
        self, case: Case, at: Setting, answers: Sequence[Answer | None]
    ) -> Float[np.ndarray, "n functions"]:
        """Return the values of the learnt functions; NaN for an answer without a contact.

        Parameters
        ----------
        case : Case
            The common material, load and model.
        at : Setting
            The conditions of the answers.
        answers : sequence of Answer or None
            The n answers.
        """
        found = np.full((len(answers), 2 + 2 * len(self.shear)), np.nan)
        scale = opening_pressure(case, at)
        for k, answer in enumerate(answers):
            contact = _contact(answer)
            if contact is not None:
                each = _integrals(contact)
                sizes = (each.width / at.root[k], each.S / scale[k], each.B / (each.width * each.S))
                found[k] = [
                    *np.log(sizes),
                    *_amplitudes(self.shear, each.s),
                    *_amplitudes(self.axial, each.b),
                    _place(answer, each.width),
                ]
        return found

    def solve(self, case: Case, at: Setting, learnt: Float[np.ndarray, "n functions"]) -> Solved:
        """Solve the balance of resistance and drive for n cases.

        Parameters
        ----------
        case : Case
            The common material, load and model.
        at : Setting
        learnt : array (n, functions)
            Values of the learnt functions.
        """
        balance = _Balance.of(self, case, at, learnt)
        x, found = _crossing(balance.excess, learnt[:, -1])
        pressure = balance.pressure(x, ALL)
        # The stone starts to move at the contact angle: there the whole contact resists.
        whole = 2.0 * balance.friction / balance.first**2
        pressure = np.where(x == 1.0, np.minimum(whole, pressure), pressure)
        pressure = np.where(at.conditions.friction == 0.0, 0.0, pressure)
        return Solved(
            np.where(found, MOVES, BEYOND_CLOSURE),
            np.where(found, pressure, np.nan),
            np.where(found, 0.0, pressure),
            {"contact_angle": np.pi / 2 - balance.width},
        )


@array_dataclass
@dataclass(frozen=True)
class _Integrals:
    """Half-width of a contact in rad, its integrals in Pa, and their shapes at the points x."""

    width: float
    S: float
    B: float
    s: Float[np.ndarray, " points"]
    b: Float[np.ndarray, " points"]


def _contact(answer: Answer | None) -> Contact | None:
    """Return the seated contact of an answer, if it has one."""
    contact = None if answer is None else answer.contact
    return contact if isinstance(contact, SeatedState) else None


def _place(answer: Answer | None, width: float) -> float:
    """Return x at which the stone moves; NaN if it does not."""
    angle = None if answer is None else answer.critical_angle
    if angle is None:
        return np.nan
    return float(2.0 / np.pi * np.arcsin(np.clip((np.pi / 2 - angle) / width, 0.0, 1.0)))


def _crossing(
    excess: Excess, guess: Float[np.ndarray, " n"]
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """Return x of the first balance and whether it exists, see `first_crossing`.

    The learnt place is refined by the secant method. A full search is made where that fails, and
    where the forces do not balance at the end of the closure.
    """
    ended = excess(np.zeros(len(guess)), ALL) > 0.0
    x, sure = refined_guess(excess, np.clip(guess, 0.0, 1.0))
    again = np.flatnonzero(~ended & ~sure)
    if len(again):
        nearer = refined_guess(lambda at, _: excess(at, again), x[again], STEPS[1])
        x[again], sure[again] = nearer
    rest = np.flatnonzero(ended | ~sure)
    found = np.ones(len(guess), dtype=bool)
    if len(rest):
        x[rest], found[rest] = first_crossing(lambda at, rows: excess(at, rest[rows]), len(rest))
    return x, found


def _integrals(contact: Contact) -> _Integrals:
    theta, sigma, shape = contact.theta, contact.contact_pressure, contact.case.stone.shape
    (rho, _), (rho_slope, z_slope) = shape.meridian(theta), shape.slopes(theta)
    width = np.pi / 2 - contact.contact_angle
    opened = np.pi / 2 - width * np.sin(np.pi / 2 * _X)
    halves = []
    for integrand in (sigma * rho * z_slope, sigma * 2.0 * rho * rho_slope):
        integral = monotone_integral(theta, integrand)
        middle = float(integral(np.array(np.pi / 2)))
        whole = middle - float(integral(np.array(contact.contact_angle)))
        halves.append((whole, (middle - np.asarray(integral(opened))) / whole))
    (S, s), (B, b) = halves
    return _Integrals(width, S, B, s, b)


def _modes(shapes: Float[np.ndarray, "n points"]) -> Float[np.ndarray, "modes points"]:
    """Return the mean of some shapes and their largest principal components, as coefficients."""
    mean = shapes.mean(axis=0)
    components = np.linalg.svd(shapes - mean, full_matrices=False)[2][:MODES]
    return np.vstack([mean, components]) @ _TO_COEFFICIENTS.T


def _amplitudes(
    modes: Float[np.ndarray, "modes points"], shape: Float[np.ndarray, " points"]
) -> Float[np.ndarray, " amplitudes"]:
    """Return the amplitudes of the modes in a shape; the modes are orthonormal at the points."""
    values = np.linalg.solve(_TO_COEFFICIENTS, modes.T).T
    return (shape - values[0]) @ values[1:].T


@array_dataclass
@dataclass(frozen=True)
class _Balance:
    """The force balance of n cases as a function of x: 1 at the contact angle, 0 at π/2."""

    case: Case
    at: Setting
    law: Law
    width: Float[np.ndarray, " n"]
    first: Float[np.ndarray, " n"]
    start: Float[np.ndarray, " n"]
    friction: Float[np.ndarray, " n"]
    whole: Float[np.ndarray, " n"]
    series: Float[np.ndarray, "points n"]

    @classmethod
    def of(
        cls, contact: SeatedContact, case: Case, at: Setting, learnt: Float[np.ndarray, "n f"]
    ) -> _Balance:
        """Return the balance for values of the learnt functions."""
        asked, count = at.conditions, len(contact.shear) - 1
        width = at.root * np.exp(learnt[:, 0])
        S = opening_pressure(case, at) * np.exp(learnt[:, 1])
        B = width * S * np.exp(learnt[:, 2])
        printed = isinstance(case.model, SeatedBalance) and case.model.as_printed
        friction, wall = 2.0 * asked.friction * S, -B if printed else B
        shear = contact.shear[0] + learnt[:, 3 : 3 + count] @ contact.shear[1:]
        axial = contact.axial[0] + learnt[:, 3 + count : 3 + 2 * count] @ contact.axial[1:]
        # Resistance F_f + F_σ = whole + the series in x.
        series = friction[:, None] * shear - wall[:, None] * axial
        first = np.asarray(case.stone.shape.width(np.pi / 2 - width))
        law = far_field_law(case, ground=case.model.far_field_ground)
        start = np.minimum(1.0, asked.size_ratio)
        return cls(case, at, law, width, first, start, friction, friction + wall,
                   np.ascontiguousarray(series.T))  # fmt: skip

    def pressure(
        self, x: Float[np.ndarray, " m"], rows: Rows, widths: np.ndarray | None = None
    ) -> Float[np.ndarray, " m"]:
        """Return the urine pressure of the closure in Pa (Eqs 15 and 16)."""
        at, load = self.at.conditions, self.case.load
        width = self._widths(x, rows) if widths is None else widths
        opening = (width - self.first[rows]) / (1.0 - self.first[rows])
        start, size, wall = self.start[rows], at.size_ratio[rows], at.wall_ratio[rows]
        radius = start + (size - start) * opening
        across = np.asarray(inflation(radius, wall, self.law, load.prestretch))
        if load.confining_pressure == 0.0:
            return across
        return across + at.load_factor[rows] * np.asarray(confining_traction(radius, wall, load))

    def excess(self, x: Float[np.ndarray, " m"], rows: Rows) -> Float[np.ndarray, " m"]:
        """Return resistance minus drive in Pa, divided by π R_s²."""
        width = self._widths(x, rows)
        resistance = self.whole[rows] + chebval(2.0 * x - 1.0, self.series[:, rows], tensor=False)
        return resistance - self.pressure(x, rows, width) * width**2

    def _widths(self, x: Float[np.ndarray, " m"], rows: Rows) -> Float[np.ndarray, " m"]:
        alpha = np.pi / 2 - self.width[rows] * np.sin(np.pi / 2 * x)
        return np.asarray(self.case.stone.shape.width(alpha))
