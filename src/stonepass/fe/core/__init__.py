"""Newton's method, mesh grading and threads, independent of the dimension of the problem."""
