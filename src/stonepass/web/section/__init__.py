"""The section through stone and wall: outlines to scale, for the picture of an answer."""
