"""Write the pages that follow from the code: keys of records and case files, the JSON schema."""

import json
from pathlib import Path

from stonepass.inputs.schema import case_schema
from stonepass.records.reference import reference

DOCS = Path(__file__).parent
CASE_FILE = DOCS / "howto" / "case-file.md"
# This script writes the text between these two lines of the page of case files.
START, END = "<!-- written by docs/write_reference.py -->\n", "<!-- end -->\n"


def main() -> None:
    """Write the files beside this script."""
    (DOCS / "reference.md").write_text(reference(), encoding="utf-8")
    schema = json.dumps(case_schema(), indent=2, ensure_ascii=False) + "\n"
    (DOCS / "data" / "case.schema.json").write_text(schema, encoding="utf-8")
    CASE_FILE.write_text(case_file_page(), encoding="utf-8")


def case_file_page() -> str:
    """Return the page of case files, with the keys of the schema as they are now."""
    before, rest = CASE_FILE.read_text(encoding="utf-8").split(START)
    return before + START + case_file_keys() + END + rest.split(END)[1]


def case_file_keys() -> str:
    """Return one table of keys for each section of a case file, as Markdown."""
    lines = []
    for section, table in case_schema()["properties"].items():
        lines += ["", f"### `[{section}]`", "", "| key | value | default | meaning |"]
        lines += ["| --- | --- | --- | --- |"]
        lines += [_row(name, each) for name, each in table["properties"].items()]
    return "\n".join(lines) + "\n\n"


def _row(name: str, each: dict) -> str:
    kinds = each["type"] if isinstance(each["type"], list) else [each["type"]]
    value = " or ".join("text" if kind == "string" else kind for kind in kinds)
    if "enum" in each:
        value = ", ".join(f"`{choice}`" for choice in each["enum"])
    elif "minimum" in each:
        value += f", {each['minimum']:g} to {each['maximum']:g}"
    default = f"`{json.dumps(each['default'], ensure_ascii=False)}`" if "default" in each else ""
    meaning = each["description"].replace("|", "\\|")
    return f"| `{name}` | {value} | {default} | {meaning} |"


if __name__ == "__main__":
    main()
