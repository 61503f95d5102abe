"""The physics: stone, ureter and load; far field, seated state, balance, critical state."""
