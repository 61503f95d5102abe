"""Write what follows from other files: keys of records and case files, JSON schema, glossary."""

import json
import re
from pathlib import Path

from stonepass.inputs.schema import case_schema
from stonepass.records.reference import reference

DOCS = Path(__file__).parent
GLOSSARY = DOCS.parent / "src" / "stonepass" / "web" / "glossary.json"
CASE_FILE = DOCS / "howto" / "case-file.md"
# This script writes the text between these two lines of the page of case files.
START, END = "<!-- written by docs/write_reference.py -->\n", "<!-- end -->\n"


def main() -> None:
    """Write the files beside this script."""
    (DOCS / "reference.md").write_text(reference(), encoding="utf-8")
    schema = json.dumps(case_schema(), indent=2, ensure_ascii=False) + "\n"
    (DOCS / "data" / "case.schema.json").write_text(schema, encoding="utf-8")
    CASE_FILE.write_text(case_file_page(), encoding="utf-8")
    GLOSSARY.write_text(glossary_words(), encoding="utf-8")


def glossary_words() -> str:
    """Return the words of the glossary with their meanings as JSON, for the page in the browser."""
    table = (DOCS / "glossary.md").read_text(encoding="utf-8").split("## Outcomes")[0]
    rows = re.findall(r"^\| (.+?) \| (.*?) ?\| (.+?) \|$", table, re.MULTILINE)[2:]
    words = {word: _plain(meaning) for word, _, meaning in rows}
    return json.dumps(words, indent=1, ensure_ascii=False) + "\n"


def _plain(text: str) -> str:
    """Return a text of Markdown without links and without marks of code."""
    return re.sub(r"\[(.+?)\]\(.+?\)", r"\1", text).replace("`", "")


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
