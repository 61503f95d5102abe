"""The command line, the Python code and the request that repeat an answer."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import tomli_w

from stonepass.inputs.case_file import values_of
from stonepass.inputs.catalogue import MODEL, all_inputs
from stonepass.inputs.command_options import command_options
from stonepass.model.case import Case
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.web.instant.question import InstantQuestion

__all__ = ["case_file_text", "repeat"]

CASE_FILE = "case.toml"
DEFAULT_MODEL = all_inputs()[MODEL].default
TOKEN = "STONEPASS_TOKEN"  # variable of the environment from which curl takes the token


def repeat(
    question: InstantQuestion,
    surrogate: Surrogate | None,
    body: Mapping[str, Any],
    address: str,
    solved: Case,
    *,
    token: bool,
) -> dict[str, str | None]:
    """Return texts that repeat an instant answer, and the solve by finite elements.

    Parameters
    ----------
    question : InstantQuestion
    surrogate : Surrogate or None
        The surrogate that answered it; None if none could.
    body : mapping
        The request.
    address : str
        Address of the server, without a slash at the end.
    solved : Case
        The case with the stiffness in its material, for the finite elements.
    token : bool
        True if the server needs a token; ``curl`` then takes it from the environment.

    Returns
    -------
    dict
        ``command`` and ``python`` for the surrogate, null without one; ``solve_command`` and
        ``solve_python`` for the finite elements; ``case_file``, the text of the file that both may
        read; ``curl`` for the request.
    """
    by_name = solved.ureter.material.reference != "" and solved.stone.shape.spheroidal
    return {
        "command": None if surrogate is None else _command(question, surrogate),
        "python": None if surrogate is None else _python(question, surrogate),
        "solve_command": _solve_command(solved) if by_name else f"stonepass pressure {CASE_FILE}",
        "solve_python": _solve_python(solved, by_name),
        "case_file": case_file_text(solved),
        "curl": _curl(body, address, token),
    }


def case_file_text(case: Case) -> str:
    """Return the text of a case file that describes a case."""
    document: dict[str, dict[str, Any]] = {}
    for key, value in values_of(case, Path()).items():
        section, _, name = key.partition(".")
        document.setdefault(section, {})[name] = value
    return tomli_w.dumps(document)


def _arguments(question: InstantQuestion) -> dict[str, float]:
    """Return the arguments of `Surrogate.evaluate` that are not the default."""
    case = question.case
    asked = {"size_ratio": case.size_ratio, "wall_ratio": case.wall_ratio} | asdict(question.held)
    defaults = {"confining_pressure": 0.0, "stiffness": 1.0}
    return {name: each for name, each in asked.items() if each != defaults.get(name)}


def _command(question: InstantQuestion, surrogate: Surrogate) -> str:
    options = {
        "size_ratio": "--xi",
        "wall_ratio": "--eta",
        "friction": "--friction",
        "confining_pressure": "--confining",
        "stiffness": "--stiffness",
    }
    words = ["stonepass", "surrogate", "evaluate", surrogate.case.ureter.material.name]
    model = surrogate.case.model.NAME
    if model != DEFAULT_MODEL:
        words += ["--model", model]
    for name, value in _arguments(question).items():
        text = f"{value:.12g}Pa" if name == "confining_pressure" else f"{value:.12g}"
        words += [options[name], text]
    return shlex.join(words)


def _python(question: InstantQuestion, surrogate: Surrogate) -> str:
    name, model = surrogate.case.ureter.material.name, surrogate.case.model.NAME
    loaded = f'"{name}"' if model == DEFAULT_MODEL else f'"{name}", "{model}"'
    given = ", ".join(f"{key}={value:.12g}" for key, value in _arguments(question).items())
    return (
        "import stonepass as sp\n\n"
        f"found = sp.load_surrogate({loaded}).evaluate({given})\n"
        "print(found.to_rows()[0])\n"
    )


def _solve_command(case: Case) -> str:
    return shlex.join(["stonepass", "pressure", *command_options(case)])


def _solve_python(case: Case, by_name: bool) -> str:
    made = f'sp.read_case("{CASE_FILE}")'
    if by_name:
        parts = (case.stone, case.ureter, case.load, case.model, case.numerics)
        made = f"sp.Case({', '.join(f'sp.{part!r}' for part in parts)})"
    return f"import stonepass as sp\n\nprint(sp.solve({made}))\n"


def _curl(body: Mapping[str, Any], address: str, token: bool) -> str:
    header = f'-H "Authorization: Bearer ${TOKEN}" ' if token else ""
    sent = shlex.quote(json.dumps(body))
    return f"curl {header}--json {sent} {shlex.quote(f'{address}/api/v1/instant')}"
