"""Array types with shapes, for annotations such as ``Float[np.ndarray, "points 3"]``.

For static type checkers these are the types of jaxtyping. At run time they are the types of
jaxtyping only if jaxtyping has been imported before this package; the tests do so to check
annotations. Otherwise an annotation is the plain array type, because importing jaxtyping takes as
long as importing NumPy and the shapes would not be used.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

__all__ = ["Bool", "Float", "Int", "Num"]

if TYPE_CHECKING or "jaxtyping" in sys.modules:
    from jaxtyping import Bool, Float, Int, Num
else:

    class _Unchecked:
        """A replacement for the types of jaxtyping that ignores the shape."""

        def __class_getitem__(cls, item):  # type: ignore[no-untyped-def]
            array_type, _shape = item
            return array_type

    Bool = Float = Int = Num = _Unchecked
