"""The paper's published results beside ours."""
