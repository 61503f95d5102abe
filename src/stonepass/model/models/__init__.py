"""The models that compute the critical pressure of a case, one file each."""
