"""The HTTP API and the page in the browser: ``stonepass serve``."""
