"""Numerical methods that do not depend on the dimension of the problem.

Newton's method, systems with reused factorisations, mesh grading, Gauss–Lobatto quadrature and
threads.
"""
