"""Generator of the reference page of JSON records, warnings and case files."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel

from stonepass.caution import SENTENCES
from stonepass.inputs.schema import case_schema
from stonepass.records.answer import AnswerRecord
from stonepass.records.assess import AssessRecord
from stonepass.records.closures import ClosuresRecord
from stonepass.records.compare import CompareRecord
from stonepass.records.curve import CurvePointRecord
from stonepass.records.fit import FitRecord
from stonepass.records.friction import FrictionRecord
from stonepass.records.invitro import InVitroRecord
from stonepass.records.rising import RisingRecord
from stonepass.records.sensitivity import SensitivityRecord
from stonepass.records.size import SizeRecord
from stonepass.records.sweep import SweepRecord

__all__ = ["RECORDS", "parts", "reference"]

# The record of each command with the option --json. Some commands print a list of records.
RECORDS: dict[str, type[BaseModel]] = {
    "pressure": AnswerRecord,
    "size": SizeRecord,
    "curve": CurvePointRecord,
    "closures": ClosuresRecord,
    "push": RisingRecord,
    "friction": FrictionRecord,
    "fit": FitRecord,
    "invitro": InVitroRecord,
    "assess": AssessRecord,
    "sensitivity": SensitivityRecord,
    "compare": CompareRecord,
    "results": SweepRecord,
}
LISTS = ("curve",)
PREFACE = """# Keys of JSON records and of case files

This page is generated from the records (`stonepass.records`) and from the declared inputs
(`stonepass.declaration`); a test keeps it in step with them. The command `stonepass NAME --json`
prints the record of that name. A number that does not exist is null. A key of a number that has a
unit ends with the unit. `record_version` is raised when a key changes its name or its meaning. The
[glossary](glossary.md) explains the words, the symbols and the outcomes.
"""


def reference() -> str:
    """Return the reference as Markdown: keys of records and case files, and codes of warnings."""
    lines = [PREFACE, "## Records", ""]
    for command, record in RECORDS.items():
        lines += [f"### `stonepass {command}`", "", *_introduction(command, record), ""]
        lines += _table(record, _inherited(record))
    lines += ["## Parts of records", ""]
    for part in parts():
        lines += [f"### {part.__name__}", "", _meaning(part), "", *_table(part, ())]
    lines += ["## Codes of warnings", "", *_cautions()]
    lines += ["## Case file", "", *_case_file()]
    return "\n".join(lines) + "\n"


def parts() -> list[type[BaseModel]]:
    """Return the models that are parts of records, beginning with those of the first record."""
    found: dict[type[BaseModel], None] = {}
    waiting = list(RECORDS.values())
    while waiting:
        for field in waiting.pop(0).model_fields.values():
            for kind in _models_in(field.annotation):
                if kind not in found and kind not in RECORDS.values():
                    found[kind] = None
                    waiting.append(kind)
    return list(found)


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for inner in get_args(annotation):
        yield from _models_in(inner)


def _inherited(record: type[BaseModel]) -> tuple[str, ...]:
    """Return the keys that a record has in common with the record of an answer."""
    known = AnswerRecord.model_fields
    extends = issubclass(record, AnswerRecord) and record is not AnswerRecord
    return tuple(known) if extends else ()


def _introduction(command: str, record: type[BaseModel]) -> list[str]:
    what = _meaning(record)
    if command in LISTS:
        what += " The command prints a list of them."
    if _inherited(record):
        what += " It has all keys of the record of `stonepass pressure`, and the following keys."
    return [what]


def _meaning(record: type[BaseModel]) -> str:
    return " ".join((inspect.getdoc(record) or "").split())


def _table(record: type[BaseModel], left_out: tuple[str, ...]) -> list[str]:
    rows = [
        f"| `{name}` | {_kind(field.annotation)} | {_cell(field.description or '')} |"
        for name, field in record.model_fields.items()
        if name not in left_out
    ]
    return ["| key | type | meaning |", "| --- | --- | --- |", *rows, ""]


def _kind(annotation: Any) -> str:
    """Return the name of a type in JSON, with a link to a part or a record."""
    if annotation is Any:
        return "any value"
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in (UnionType, Union):
        return " or ".join(map(_kind, inner))
    if origin in (list, dict):
        kind = _kind(inner[-1])
        kind = f"({kind})" if " or " in kind else kind
        return f"{'list' if origin is list else 'object'} of {kind}"
    if issubclass(annotation, BaseModel):
        for command, record in RECORDS.items():
            if annotation is record:
                return f"[record](#stonepass-{command})"
        return f"[{annotation.__name__}](#{annotation.__name__.lower()})"
    words = {float: "number", int: "whole number", str: "text", bool: "true or false"}
    return "null" if annotation is NoneType else words[annotation]


def _cautions() -> list[str]:
    rows = [f"| `{code}` | {_cell(sentence)} |" for code, sentence in SENTENCES.items()]
    return [
        "The record of a warning contains its code, its sentence, and the values that are shown in "
        "braces here.",
        "",
        "| code | sentence |",
        "| --- | --- |",
        *rows,
        "",
    ]


def _case_file() -> list[str]:
    rows = ["| key | type | default | meaning |", "| --- | --- | --- | --- |"]
    for section, keys in case_schema()["properties"].items():
        for name, each in keys["properties"].items():
            kinds = each["type"]
            kind = " or ".join(kinds) if isinstance(kinds, list) else kinds
            default = "" if "default" not in each else f"`{each['default']}`"
            allowed = ""
            if "enum" in each:
                allowed = " One of " + ", ".join(f"`{value}`" for value in each["enum"]) + "."
            if "minimum" in each:
                allowed = f" From {each['minimum']:g} to {each['maximum']:g}."
            meaning = each["description"] + allowed
            rows.append(f"| `{section}.{name}` | {kind} | {default} | {_cell(meaning)} |")
    return rows


def _cell(text: str) -> str:
    """Return a text for a cell of a Markdown table, with escaped bars."""
    return text.replace("|", "\\|")
