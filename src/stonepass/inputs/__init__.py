"""Readers and writers of case files, material files, shapes and measured pressures."""
