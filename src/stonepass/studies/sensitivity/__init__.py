"""Sensitivity of the critical pressure and of the critical size to uncertain inputs."""
