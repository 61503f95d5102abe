"""Laboratory: material constants from tests, friction from in-vitro series."""
