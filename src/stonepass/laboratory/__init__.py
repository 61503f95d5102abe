"""From the bench and the clinic: constants of walls, in-vitro series, a person's ureter."""
