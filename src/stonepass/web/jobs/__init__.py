"""Questions that take seconds: a bounded queue, and worker processes that answer."""
