"""Results as typed, versioned records: what every door shows."""
