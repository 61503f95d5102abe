"""Studies of many cases: jobs, executors, the solution cache, response surfaces and samples."""
