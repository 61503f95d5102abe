"""The version of the software and the disclaimer that every output contains."""

__all__ = ["DISCLAIMER", "VERSION"]

VERSION = "0.1.0"
DISCLAIMER = "Research use only. Not a medical device."
