"""The instant answer: numbers and curves of a surrogate for one case, within milliseconds."""
