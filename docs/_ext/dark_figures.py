"""A dark version of every figure and diagram that a page shows, for the dark theme of the site.

The pages name one figure. This extension recolours it and shows the result in the dark theme alone,
and the figure itself in the light theme alone.
"""

import os
from pathlib import Path

from dark_colours import dark
from docutils import nodes
from sphinx.transforms import SphinxTransform


class DarkFigures(SphinxTransform):
    """Put the dark version of each figure beside it."""

    default_priority = 100

    def apply(self):
        """Write the dark versions and refer to them."""
        page = Path(self.env.doc2path(self.env.docname))
        site = Path(self.env.srcdir).resolve()
        folders, made = [site / name for name in ("img", "figures")], site / "generated" / "img"
        for image in list(self.document.findall(nodes.image)):
            source = (page.parent / image["uri"]).resolve()
            if source.suffix != ".svg" or source.parent not in folders:
                continue
            made.mkdir(parents=True, exist_ok=True)
            target = made / f"{source.stem}-dark.svg"
            target.write_text(dark(source.read_text(encoding="utf-8")), encoding="utf-8")
            twin = image.deepcopy()
            twin["uri"] = Path(os.path.relpath(target, page.parent)).as_posix()
            twin["classes"].append("only-dark")
            image["classes"].append("only-light")
            image.parent.insert(image.parent.index(image) + 1, twin)
            self.env.note_dependency(str(source))


def setup(app):
    """Register the transform."""
    app.add_transform(DarkFigures)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
