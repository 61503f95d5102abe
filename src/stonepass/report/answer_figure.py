"""The picture of an answer, which depends on the type of its contact."""

from __future__ import annotations

from functools import singledispatch

from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.models.elastic_foundation import BeamState
from stonepass.model.states.loaded_state import PushedState
from stonepass.model.states.seated_state import SeatedState
from stonepass.report.beam_figure import beam_figure
from stonepass.report.case_figure import case_figure
from stonepass.report.contact_figure import contact_figure
from stonepass.report.push_figure import push_figure

__all__ = ["answer_figure", "draw"]


def answer_figure(answer: Answer) -> Figure:
    """Draw an answer.

    Raises
    ------
    BadInput
        No stone is in contact, so there is nothing to draw.
    """
    if answer.contact is None:
        raise BadInput("figure", answer.outcome.name, "asked for where there is a contact to draw")
    return draw(answer.contact, answer)


@singledispatch
def draw(contact: object, answer: Answer) -> Figure:
    """Draw an answer whose contact has this type; a new model registers its picture here.

    A contact without a picture of its own is drawn as its pressure over the angle.
    """
    return contact_figure(answer)


@draw.register
def _(contact: BeamState, answer: Answer) -> Figure:
    return beam_figure(answer)


@draw.register
def _(contact: PushedState, answer: Answer) -> Figure:
    return push_figure(answer)


@draw.register
def _(contact: SeatedState, answer: Answer) -> Figure:
    return case_figure(answer)
