"""Parsing of files of unknown origin in a child process with limited memory and time."""
