"""Information that the API gives about itself: inputs, materials, pressure limits, words."""

from __future__ import annotations

import json
from dataclasses import MISSING
from functools import lru_cache
from importlib.resources import files
from typing import Any

from stonepass.about import DISCLAIMER, VERSION
from stonepass.clinic.pressure_limits import LIMITS
from stonepass.declaration import DeclaredInput, Input, Kind
from stonepass.inputs.case_record import describe_material
from stonepass.inputs.catalogue import all_inputs, models_with
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.constants import ConstantDeclaration, constants_of
from stonepass.materials.known_laws import KNOWN_LAWS
from stonepass.studies.stiffness_input import STIFFNESS
from stonepass.studies.surrogates.store import shipped_surrogates

__all__ = ["about", "glossary", "inputs", "laws", "materials", "pressure_limits"]

UNITS = {Kind.LENGTH: "m", Kind.PRESSURE: "Pa"}
LINKS = {
    "page": "/",
    "openapi": "/api/v1/openapi.json",
    "inputs": "/api/v1/inputs",
    "materials": "/api/v1/materials",
    "laws": "/api/v1/laws",
    "pressure_limits": "/api/v1/pressure-limits",
    "glossary": "/api/v1/glossary",
    "instant": "/api/v1/instant",
    "jobs": "/api/v1/jobs",
    "uploads": "/api/v1/uploads/{kind}",
    "report": "/api/v1/report",
}


def about() -> dict[str, Any]:
    """Return name, version, notice and addresses."""
    return {"name": "stonepass", "version": VERSION, "notice": DISCLAIMER, "links": LINKS}


@lru_cache(maxsize=1)
def inputs() -> list[dict[str, Any]]:
    """Return every declared input of a case, and the stiffness, in the order of the help."""
    found = [_described(each) for each in all_inputs().values()]
    return [*found, _described(STIFFNESS) | {"key": "stiffness", "section": None}]


def _described(each: DeclaredInput) -> dict[str, Any]:
    declaration: Input = each.declaration
    default = None if each.default is MISSING else each.default
    return {
        "key": each.key,
        "section": each.section,
        "name": each.name,
        "label": each.title.replace("_", " "),
        "kind": declaration.kind.value,
        "unit": UNITS.get(declaration.kind),
        "bounds": None if declaration.bounds is None else list(declaration.bounds),
        "default": float(default) if isinstance(default, float) else default,
        "shown_default": declaration.shown_default or None,
        "choices": list(declaration.choices),
        "meaning": declaration.meaning,
        "option": declaration.option,
        "models": models_with(each.name) if each.section == "method" else [],
    }


@lru_cache(maxsize=1)
def materials() -> list[dict[str, Any]]:
    """Return the materials of the catalogue with their constants and sources."""
    instant = {name for name, _ in shipped_surrogates()}
    return [
        describe_material(each)
        | {
            "source": each.source,
            "test": each.test,
            "verified": each.verified,
            "instant": name in instant,
            "stable": getattr(each.law, "defect", None) is None,
            "declarations": [
                {"name": c.name, "symbol": c.symbol, "unit": c.unit, "meaning": c.meaning,
                 "value": getattr(each.law, c.name)}
                for c in constants_of(each.law)
            ],
        }
        for name, each in CATALOGUE.items()
    ]  # fmt: skip


@lru_cache(maxsize=1)
def laws() -> list[dict[str, Any]]:
    """Return the laws that can be fitted, with the declarations of their constants."""
    return [
        {"name": name, "constants": [_constant(each) for each in constants_of(law)]}
        for name, law in KNOWN_LAWS.items()
    ]


def _constant(each: ConstantDeclaration) -> dict[str, Any]:
    return {
        "name": each.name,
        "symbol": each.symbol,
        "unit": each.unit,
        "meaning": each.meaning,
        "allowed": each.allowed,
        "default": each.default,
        "held": each.held,
    }


def pressure_limits() -> list[dict[str, Any]]:
    """Return the published pressure limits with their sources."""
    return [
        {"pressure_kPa": each.pressure / 1e3, "meaning": each.what, "source": each.source}
        for each in LIMITS
    ]


@lru_cache(maxsize=1)
def glossary() -> dict[str, str]:
    """Return the words of the glossary of the documentation with their meanings."""
    text = (files("stonepass.web") / "glossary.json").read_text(encoding="utf-8")
    words: dict[str, str] = json.loads(text)
    return words
