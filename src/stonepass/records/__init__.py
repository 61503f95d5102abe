"""Results as typed, versioned records for JSON and CSV."""
