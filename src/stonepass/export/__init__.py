"""Cases for other finite-element programs, and their results read back.

`write` writes a case in one of the `formats`. A new format is one file that makes a `Writer` and
one line in `export.registry`. Importing this package loads no numerical library.
"""

from stonepass.export.api import formats, write
from stonepass.export.contract import Export, Limit, Option, Writer

__all__ = ["Export", "Limit", "Option", "Writer", "formats", "write"]
