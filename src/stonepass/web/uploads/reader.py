"""The module that the sandbox runs in a child process to read an uploaded file."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from stonepass.bench.test_files import table_of_test
from stonepass.errors import BadInput
from stonepass.sandbox.worker import serve
from stonepass.surface.readers import load_libraries, read_surface_image
from stonepass.surface.surface_image import PixelArea, SurfaceImage
from stonepass.web.api_words import api_words, in_api_words

__all__ = ["parse"]

SIDE = 1400  # largest number of pixels along a side of a preview
DARKEST, BRIGHTEST = 0.5, 99.5  # percentiles of the values that are shown black and white
NEEDS = {
    "extension_mm": ["gauge_length"],
    "force_N": ["width", "thickness"],
    "pressure_kPa": ["inner", "outer"],
}


def parse(request: Mapping[str, Any]) -> tuple[dict[str, Any], memoryview]:
    """Read the file of a request; return a summary and, for a picture, a preview as PNG."""
    path = Path(request["path"])
    try:
        if request["kind"] == "fit":
            return _table(path), memoryview(b"")
        area = None if request["area"] is None else PixelArea(*request["area"])
        return _picture(read_surface_image(path, area))
    except BadInput as problem:
        raise in_api_words(problem) from None


def _table(path: Path) -> dict[str, Any]:
    """Return the kind of test, the columns, and the sizes at rest that a fit needs."""
    test, columns = table_of_test(path)
    return {
        "test": test,
        "rows": len(columns.lines),
        "columns": list(columns),
        "ranges": {name: [float(np.min(v)), float(np.max(v))] for name, v in columns.items()},
        "needs": [size for name in columns for size in NEEDS.get(name, [])],
    }


def _picture(picture: SurfaceImage) -> tuple[dict[str, Any], memoryview]:
    rows, columns = picture.values.shape
    step = -(-max(rows, columns) // SIDE)
    drawn = io.BytesIO()
    Image.fromarray(_shades(picture.values[::step, ::step])).save(drawn, "PNG")
    area = picture.area
    header = {
        "width": columns,
        "height": rows,
        "preview_step": step,
        "heights": picture.full_scale == 0,
        "pixel_um": None if picture.pixel is None else [1e6 * side for side in picture.pixel],
        "pixel_source": picture.pixel_source,
        "pixel_hint": picture.pixel_hint,
        "area": [area.left, area.top, area.right, area.bottom],
        "notes": [api_words(note) for note in picture.notes],
    }
    return header, drawn.getbuffer()


def _shades(values: np.ndarray) -> np.ndarray:
    """Return grey levels of 8 bits; missing heights are black."""
    known = values[np.isfinite(values)]
    if not known.size:
        return np.zeros(values.shape, np.uint8)
    low, high = np.percentile(known, [DARKEST, BRIGHTEST])
    scaled = (values - low) / max(high - low, np.finfo(float).tiny)
    return (255.0 * np.clip(np.nan_to_num(scaled), 0.0, 1.0)).astype(np.uint8)


if __name__ == "__main__":
    raise SystemExit(serve(lambda request: load_libraries(Path(request["path"])), parse))
