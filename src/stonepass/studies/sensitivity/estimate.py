"""Estimates of sensitivity indices with their confidence intervals."""

from __future__ import annotations

import enum
from dataclasses import dataclass

__all__ = [
    "LEVEL",
    "Effects",
    "Gap",
    "IndexEstimate",
    "Indices",
    "Interaction",
    "Response",
    "Sensitivities",
]

LEVEL = 0.95  # level of the confidence intervals


@dataclass(frozen=True)
class IndexEstimate:
    """An estimate with its 95 % confidence interval.

    Attributes
    ----------
    value : float
        The estimate.
    half_width : float
        Half the width of the confidence interval, which is centred at the estimate.
    """

    value: float
    half_width: float

    @property
    def low(self) -> float:
        """Lower end of the confidence interval."""
        return self.value - self.half_width

    @property
    def high(self) -> float:
        """Upper end of the confidence interval."""
        return self.value + self.half_width

    def overlaps(self, other: IndexEstimate) -> bool:
        """Return True if the two confidence intervals overlap."""
        return self.low <= other.high and other.low <= self.high


@dataclass(frozen=True)
class Indices:
    """Sobol' indices of one input.

    The first-order index is the fraction of the variance of the response that the input explains
    alone. The total index is the fraction in which the input takes part, alone or in interactions.

    Attributes
    ----------
    key : str
        Key of the input.
    first, total : IndexEstimate
        First-order and total index.
    """

    key: str
    first: IndexEstimate
    total: IndexEstimate

    @property
    def importance(self) -> IndexEstimate:
        """The number by which inputs are ordered: the total index."""
        return self.total


@dataclass(frozen=True)
class Interaction:
    """Second-order Sobol' index of two inputs.

    The index is the fraction of the variance that is due to the interaction of both inputs.

    Attributes
    ----------
    keys : (str, str)
        Keys of the two inputs.
    second : IndexEstimate
        The index.
    """

    keys: tuple[str, str]
    second: IndexEstimate


@dataclass(frozen=True)
class Effects:
    """Elementary effects of one input by the method of Morris.

    An elementary effect is the change of the response if the input alone is moved, divided by the
    moved fraction of the way from its 5 % to its 95 % quantile.

    Attributes
    ----------
    key : str
        Key of the input.
    mean_absolute : IndexEstimate
        Mean absolute effect μ*, in the unit of the response.
    mean : float
        Mean effect μ.
    spread : float
        Standard deviation σ of the effects. It is large compared with μ* if the effect depends on
        the input itself or on other inputs.
    """

    key: str
    mean_absolute: IndexEstimate
    mean: float
    spread: float

    @property
    def importance(self) -> IndexEstimate:
        """The number by which inputs are ordered: the mean absolute effect."""
        return self.mean_absolute


@dataclass(frozen=True)
class Response:
    """A number that follows from the outcome and the critical pressure of a case.

    Attributes
    ----------
    name : str
        Name in records: "pressure", "rank", "moves" or "answered".
    title : str
        The response in words.
    unit : str
        Unit in which effects are shown; empty for a number without unit.
    yes_or_no : bool
        True if the response is 1 or 0.
    """

    name: str
    title: str
    unit: str = ""
    yes_or_no: bool = False


class Gap(enum.Enum):
    """The reason why there is no sensitivity of a response; its value says what the response is."""

    CONSTANT = "is the same in all samples"
    RARE = "differs in too few samples"
    INCOMPLETE = "is unknown in too many samples"


@dataclass(frozen=True)
class Sensitivities:
    """Sensitivity of one response to all uncertain inputs.

    Attributes
    ----------
    response : Response
        The response.
    inputs : tuple of Indices or tuple of Effects
        Sensitivity to each input in descending order of importance; empty with a `gap`.
    interactions : tuple of Interaction
        Second-order indices of all pairs of inputs in descending order; empty for Morris.
    groups : int
        Number of groups of samples (of a Saltelli design, or trajectories of Morris).
    dropped : int
        Number of groups that were left out because the response of a member does not exist.
    gap : Gap or None
        Reason why there is no sensitivity; None if there is one.
    """

    response: Response
    inputs: tuple[Indices, ...] | tuple[Effects, ...]
    interactions: tuple[Interaction, ...] = ()
    groups: int = 0
    dropped: int = 0
    gap: Gap | None = None
