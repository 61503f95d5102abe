"""The critical state of the paper's model, in which drive and resistance balance (Eqs 3–8)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.model.closure import Closure
from stonepass.model.force_balance import drive, resistance
from stonepass.model.roots import first_root
from stonepass.model.states.seated_state import Contact
from stonepass.units import Values

__all__ = ["CriticalState", "balance_pressure", "critical_state"]


@dataclass(frozen=True)
class CriticalState:
    """The state of the paper's model in which the stone starts to move.

    Attributes
    ----------
    angle : float
        Angle α in rad up to which the contact has opened.
    pressure : float
        Urine pressure in Pa.
    at_edge : bool
        True if the drive already exceeds the resistance at the contact angle α₀.
    """

    angle: float
    pressure: float
    at_edge: bool = False


def critical_state(
    contact: Contact, closure: Closure, *, as_printed: bool = False
) -> CriticalState | None:
    """Find the smallest α in [α₀, π/2] with F_re = F_dr; the equation may have several roots.

    Parameters
    ----------
    contact : Contact
        The seated contact, pressures in Pa.
    closure : Closure
    as_printed : bool
        True to use the sign of Eq. 5 as it is printed.

    Returns
    -------
    CriticalState or None
        None if drive and resistance do not balance at any α.

    References
    ----------
    Liu et al. 2022, Eqs 3–8; docs/theory.md, "Closure and critical state".
    """
    forces = resistance(contact, as_printed=as_printed)
    width = contact.case.stone.shape.width
    first, last = contact.contact_angle, np.pi / 2
    # Without friction nothing holds the stone under any load, so P_ucr = 0 at α₀.
    if contact.case.stone.friction == 0.0:
        return CriticalState(first, 0.0)

    def excess(alpha: Values) -> Values:
        push = drive(closure.pressure(contact, alpha), width(np.asarray(alpha)))
        return forces.total(alpha) - push

    found = first_root(excess, first, last)
    if found is None:
        return None
    if found == first:
        disc = float(width(np.array(first))) ** 2
        # This is the P_u whose drive equals the resistance of the whole contact.
        push = max(float(forces.total(np.array(first))), 0.0)
        return CriticalState(first, push / disc, at_edge=True)
    return CriticalState(found, float(closure.pressure(contact, np.array(found))))


def balance_pressure(
    contact: Contact, closure: Closure, *, as_printed: bool = False
) -> float | None:
    """Return the critical pressure P_ucr of a seated stone for a given closure.

    For the parameters see `critical_state`.

    Returns
    -------
    float or None
        P_ucr in Pa; None if drive and resistance do not balance at any α in [α₀, π/2].
    """
    found = critical_state(contact, closure, as_printed=as_printed)
    return None if found is None else found.pressure
