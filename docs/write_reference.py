"""Write the pages that follow from the code: keys of records and case files, the JSON schema."""

import json
from pathlib import Path

from stonepass.inputs.schema import case_schema
from stonepass.records.reference import reference

DOCS = Path(__file__).parent


def main() -> None:
    """Write both files beside this script."""
    (DOCS / "reference.md").write_text(reference(), encoding="utf-8")
    schema = json.dumps(case_schema(), indent=2, ensure_ascii=False) + "\n"
    (DOCS / "data" / "case.schema.json").write_text(schema, encoding="utf-8")


if __name__ == "__main__":
    main()
