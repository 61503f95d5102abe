"""What a worker process does for each kind of job; each module loads the libraries it needs."""
