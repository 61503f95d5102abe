"""Patients: assessment of one stone, published cohorts, pressure limits."""
