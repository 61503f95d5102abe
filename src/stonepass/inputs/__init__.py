"""Readers of the files that describe a question: cases, materials, shapes, measurements."""
