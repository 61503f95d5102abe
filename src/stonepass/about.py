"""What every output says of where it comes from."""

__all__ = ["DISCLAIMER", "VERSION"]

VERSION = "0.1.0"
DISCLAIMER = "Research use only. Not a medical device."
