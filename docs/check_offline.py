"""Check that the built site loads nothing from another machine: ``check_offline.py FOLDER``."""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path

# What a browser loads by itself; a link (`a`) waits for a click.
LOADED = {
    "script": "src",
    "link": "href",
    "img": "src",
    "source": "src",
    "video": "src",
    "iframe": "src",
    "object": "data",
    "embed": "src",
}
ELSEWHERE = re.compile(r"(https?:)?//", re.IGNORECASE)
IN_STYLE = re.compile(r"""(?:url\(|@import)\s*["']?((?:https?:)?//[^"')\s]+)""", re.IGNORECASE)
FEWEST_PAGES = 40  # fewer means that the site was not built


class _Loads(HTMLParser):
    """Collects the addresses that a page loads."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        address = dict(attributes).get(LOADED.get(tag, ""))
        if address and ELSEWHERE.match(address):
            self.found.append(address)


def loads_of(path):
    """Return the addresses on other machines that a page or a style sheet loads."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".css":
        return IN_STYLE.findall(text)
    parser = _Loads()
    parser.feed(text)
    return parser.found + IN_STYLE.findall(text)


def main(folder):
    """Return 1 and name the places where something is loaded from elsewhere, else 0."""
    pages = sorted(folder.rglob("*.html"))
    if len(pages) < FEWEST_PAGES:
        print(f"{folder} has {len(pages)} pages, but must have at least {FEWEST_PAGES}.")
        return 1
    files = [*pages, *sorted(folder.rglob("*.css"))]
    found = [(path, address) for path in files for address in loads_of(path)]
    for path, address in found:
        print(f"{path.relative_to(folder)} loads {address}")
    print(f"{len(pages)} pages were checked; {len(found)} addresses on other machines are loaded.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
