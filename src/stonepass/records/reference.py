"""The reference of the keys of JSON records, written from the records themselves."""

from __future__ import annotations

from pydantic import BaseModel

from stonepass.inputs.schema import case_schema
from stonepass.records.answer import AnswerRecord, SolverRecord
from stonepass.records.base import CautionRecord
from stonepass.records.size import SizeRecord

__all__ = ["RECORDS", "reference"]

# Records by the title under which the reference has them.
RECORDS: dict[str, type[BaseModel]] = {
    "Answer (`stonepass pressure --json`)": AnswerRecord,
    "Critical size (`stonepass size --json`)": SizeRecord,
    "Warning": CautionRecord,
    "Solver": SolverRecord,
}


def reference() -> str:
    """The reference as Markdown: keys of JSON records, then keys of case files."""
    parts = [
        "# Keys of JSON records and of case files",
        "",
        "This page is generated from the records (`stonepass.records`) and from the declared",
        "inputs (`stonepass.declaration`); a test keeps it in step with them.",
        "",
    ]
    for title, record in RECORDS.items():
        known = AnswerRecord.model_fields if record is SizeRecord else {}
        parts += [f"## {title}", ""]
        if known:
            parts += [
                "All keys of an answer, which describe the state at the critical size, and:",
                "",
            ]
        parts += ["| key | type | meaning |", "| --- | --- | --- |"]
        for name, each in record.model_fields.items():
            if name in known:
                continue
            kind = str(each.annotation).replace("typing.", "").replace("|", "or")
            if isinstance(each.annotation, type):
                kind = each.annotation.__name__
            parts.append(f"| `{name}` | {_plain(kind)} | {each.description or ''} |")
        parts.append("")
    parts += ["## Case file", "", "| key | type | default | meaning |", "| --- | --- | --- | --- |"]
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
            parts.append(f"| `{section}.{name}` | {kind} | {default} | {meaning} |")
    return "\n".join(parts) + "\n"


def _plain(kind: str) -> str:
    kind = kind.replace("stonepass.records.base.", "").replace("stonepass.records.answer.", "")
    return kind.replace("None", "null").replace("<class '", "").replace("'>", "")
