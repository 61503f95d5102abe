"""Friction coefficient from a micrograph or a height map of the stone's surface."""
