"""The models that answer a case, one file each."""
