"""Conclusions of a sensitivity study in sentences: which inputs matter most, and which do not."""

from __future__ import annotations

from collections.abc import Sequence

from stonepass.studies.sensitivity.estimate import (
    Effects,
    Gap,
    IndexEstimate,
    Indices,
    Sensitivities,
)
from stonepass.studies.sensitivity.evaluator import OUTSIDE, outcome_name
from stonepass.studies.sensitivity.responses import ANSWERED, MOVES, PRESSURE
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.studies.sensitivity.tornado import Bar, End, Tornado

__all__ = ["conclusions"]

SMALL = 0.05  # part of the variance, or of the largest effect, below which an input does not matter
UNKNOWN = outcome_name(OUTSIDE)
Input = Indices | Effects


def conclusions(found: Sensitivity) -> tuple[str, ...]:
    """Return what a study shows: outcomes, order of the inputs, interactions, and tornado.

    Two inputs are said to be indistinguishable if the confidence intervals of their indices
    overlap. An input does not matter if the upper end of its interval is below 5 % of the variance,
    or of the largest effect.

    References
    ----------
    docs/howto/sensitivity.md, "What the text says".
    """
    told = [_outcomes(found), *_error(found), *_ranking(found, found.main), *_interactions(found)]
    for name in (MOVES.name, ANSWERED.name):
        for each in found.responses:
            if each.response.name == name:
                told += _yes_or_no(found, each)
    told += _tornado(found, found.pressures)
    if found.sizes is not None:
        told += _tornado(found, found.sizes)
    return tuple(told)


def _outcomes(found: Sensitivity) -> str:
    parts = _listed([f"{name} in {_percent(part)}" for name, part in found.outcomes])
    text = f"The outcome of the {found.evaluated} cases is {parts}."
    if found.main.response is PRESSURE:
        return f"{text} The critical pressure is known in all of them."
    return (
        f"{text} Because the critical pressure is not known in all cases, the order of the inputs "
        "is that of its rank, in which a lower bound stands for a missing critical pressure."
    )


def _error(found: Sensitivity) -> list[str]:
    if found.error is None:
        return []
    return [
        f"The critical pressures are those of the {found.source}, whose stated error is at most "
        f"{found.error / 1e3:.2g} kPa."
    ]


def _ranking(found: Sensitivity, each: Sensitivities) -> list[str]:
    """Return the order of the inputs, in groups whose intervals overlap."""
    if not each.inputs:
        return [f"The order of the inputs is not known: {each.response.title} {_why_empty(each)}."]
    largest = each.inputs[0].importance.value
    small = SMALL if isinstance(each.inputs[0], Indices) else SMALL * largest
    minor = [one for one in each.inputs if one.importance.high < small]
    groups = _groups([one for one in each.inputs if one not in minor])
    told = []
    for k, group in enumerate(groups):
        told.append(_group(found, each, group, first=k == 0))
    if minor:
        told.append(_minor(found, each, minor))
    return told


def _groups(inputs: Sequence[Input]) -> list[list[Input]]:
    groups: list[list[Input]] = []
    for one in inputs:
        if groups and one.importance.overlaps(groups[-1][0].importance):
            groups[-1].append(one)
        else:
            groups.append([one])
    return groups


def _group(found: Sensitivity, each: Sensitivities, group: list[Input], *, first: bool) -> str:
    names = _named(found, group)
    amounts = [_amount(each, one.importance) for one in group]
    if len(group) == 1:
        if not first:
            return f"{_capital(names)} comes next with {amounts[0]}."
        doing = _doing(each, group[0])
        return f"{_capital(names)} matters most for {each.response.title}: {doing}."
    place = f"matter most for {each.response.title}," if first else "come next"
    return (
        f"{_capital(names)} {place} with {_listed(amounts)}{_of_what(each)}; they cannot be told "
        "apart, because their confidence intervals overlap."
    )


def _of_what(each: Sensitivities) -> str:
    return " of its variance" if isinstance(each.inputs[0], Indices) else ""


def _doing(each: Sensitivities, one: Input) -> str:
    """Return what an input does to the response, with the confidence interval."""
    if isinstance(one, Indices):
        return (
            f"it takes part in {_amount(each, one.total)} of the variance, and alone it explains "
            f"{_amount(each, one.first)}"
        )
    return (
        "moved from its 5 % to its 95 % quantile it changes the response by "
        f"{_amount(each, one.mean_absolute)} on average, with a standard deviation of "
        f"{_effect(each, one.spread)} between trajectories"
    )


def _minor(found: Sensitivity, each: Sensitivities, minor: list[Input]) -> str:
    does = "does" if len(minor) == 1 else "do"
    largest = max(one.importance.high for one in minor)
    if isinstance(minor[0], Indices):
        limit = f"at most {_percent(largest)} of the variance"
    else:
        limit = f"at most {_effect(each, largest)}"
    name = "its total index is" if isinstance(minor[0], Indices) else "its mean effect is"
    if len(minor) > 1:
        name = name.replace("its", "their").replace("index is", "indices are")
        name = name.replace("effect is", "effects are")
    return (
        f"{_capital(_named(found, minor))} {does} not matter for {each.response.title}: with 95 % "
        f"confidence {name} {limit}."
    )


def _interactions(found: Sensitivity) -> list[str]:
    main = found.main
    if not main.interactions:
        return []
    largest = main.interactions[0]
    if largest.second.low <= 0.0:
        return ["No interaction of two inputs can be distinguished from zero."]
    names = _listed([f"the {found.title(key)}" for key in largest.keys])
    return [
        f"The largest interaction is that of {names}, which causes "
        f"{_amount(main, largest.second)} of the variance."
    ]


def _yes_or_no(found: Sensitivity, each: Sensitivities) -> list[str]:
    if each.inputs:
        return _ranking(found, each)[:1]
    if each.response is ANSWERED and each.gap is Gap.CONSTANT:  # the outcomes say so
        return []
    return [f"There is no sensitivity of {each.response.title}: it {_why_empty(each)}."]


def _why_empty(each: Sensitivities) -> str:
    if each.gap is not None and each.gap is not Gap.INCOMPLETE:
        return each.gap.value
    return f"is unknown in a case of {each.dropped} of {each.groups} groups of samples"


def _tornado(found: Sensitivity, tornado: Tornado) -> list[str]:
    """Return the effect of one input at a time: the largest, the smallest, and missing ends."""
    quantity = f"the {tornado.quantity}"
    if tornado.limit is not None:
        quantity += f" at {tornado.limit / 1e3:.4g} kPa"
    centre = tornado.centre
    told = [f"With all inputs at their medians {quantity} is {centre.describe(tornado.unit)}."]
    if centre.value is None:
        told = [f"With all inputs at their medians there is no {tornado.quantity}: "
                f"{centre.describe()}."]  # fmt: skip
        if centre.outcome == UNKNOWN:
            told = [f"With all inputs at their medians the {tornado.quantity} is not known, "
                    f"because they are outside the range of the {found.source}."]  # fmt: skip
    known = [bar for bar in tornado.bars if bar.span is not None]
    if known and not any(bar.span for bar in known):
        return [*told, f"None of the inputs changes the {tornado.quantity} alone."]
    apart = len(known) > 1 and known[0].span != known[-1].span
    if known:
        than = ", more than any other input" if apart and len(known) == len(tornado.bars) else ""
        told.append(f"Alone, {_moved(found, tornado, known[0])}{than}.")
    if apart:
        told.append(f"{_capital(_moved(found, tornado, known[-1]))}, which is the least.")
    for bar in tornado.bars:
        told += [_missing(found, tornado, bar, end) for end in (bar.low, bar.high)
                 if end.value is None]  # fmt: skip
    return told


def _moved(found: Sensitivity, tornado: Tornado, bar: Bar) -> str:
    low, high = (_at(found, tornado, bar.key, end) for end in (bar.low, bar.high))
    return f"the {found.title(bar.key)} moves the {tornado.quantity} from {low} to {high}"


def _at(found: Sensitivity, tornado: Tornado, key: str, end: End) -> str:
    assert end.input is not None
    return f"{end.describe(tornado.unit)} (at {found.study.uncertain[key].show(end.input)})"


def _missing(found: Sensitivity, tornado: Tornado, bar: Bar, end: End) -> str:
    assert end.input is not None
    shown = found.study.uncertain[bar.key].show(end.input)
    where = f"where the {found.title(bar.key)} is {shown} and all other inputs have their medians"
    if end.outcome == UNKNOWN:
        return (
            f"The {tornado.quantity} is not known {where}, because this is outside the range of "
            f"the {found.source}."
        )
    bound = "" if end.lower_bound is None else (
        f", but it is above {end.lower_bound:.3g} {tornado.unit}"
    )  # fmt: skip
    return f"There is no {tornado.quantity} {where} (outcome {end.outcome}){bound}."


def _amount(each: Sensitivities, estimate: IndexEstimate) -> str:
    """Return an estimate with its 95 % interval, e.g. ``71 % (66 to 76 %)``."""
    if each.inputs and isinstance(each.inputs[0], Effects):
        low, high = max(estimate.low, 0.0), estimate.high
        return f"{_effect(each, estimate.value)} ({low:.2g} to {_effect(each, high)})"
    # An index is between 0 and 1, but the ends of its interval may not be.
    low, high = (100.0 * min(max(end, 0.0), 1.0) for end in (estimate.low, estimate.high))
    return f"{_percent(estimate.value)} ({low:.0f} to {high:.0f} %)"


def _effect(each: Sensitivities, value: float) -> str:
    return f"{value:.2g} {each.response.unit}".rstrip()


def _percent(part: float) -> str:
    percent = 100.0 * min(max(part, 0.0), 1.0)
    return f"{percent:.1f} %" if 0.0 < percent < 1.0 else f"{percent:.0f} %"


def _named(found: Sensitivity, inputs: Sequence[Input]) -> str:
    return _listed([f"the {found.title(one.key)}" for one in inputs])


def _listed(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
