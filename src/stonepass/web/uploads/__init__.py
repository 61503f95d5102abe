"""Uploaded files: held in memory for a while, and read in the sandbox."""
