"""Pictures to numbers: micrographs and height maps to a friction coefficient."""
