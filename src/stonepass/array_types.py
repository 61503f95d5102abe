"""Types of arrays with their shapes, for annotations: ``Float[np.ndarray, "points 3"]``.

They are those of jaxtyping for static checkers and for whoever checks annotations at run time, who
has loaded jaxtyping before this package, as the tests do. In any other process they are the bare
array types: importing jaxtyping takes as long as importing NumPy, and nothing would read them.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

__all__ = ["Bool", "Float", "Int", "Num"]

if TYPE_CHECKING or "jaxtyping" in sys.modules:
    from jaxtyping import Bool, Float, Int, Num
else:

    class _Unchecked:
        """Stands for the array type alone."""

        def __class_getitem__(cls, item):  # type: ignore[no-untyped-def]
            array_type, _shape = item
            return array_type

    Bool = Float = Int = Num = _Unchecked
