"""The seated state for other finite-element programs, and their results read back."""
