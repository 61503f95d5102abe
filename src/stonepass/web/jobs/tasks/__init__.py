"""The work for each kind of job in a worker process; each module loads the libraries it needs."""
