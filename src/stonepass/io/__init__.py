"""Readers and writers of CSV, TOML and text files; writable folders. No physics."""
