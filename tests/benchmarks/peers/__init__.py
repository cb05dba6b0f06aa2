"""Other graders, really installed, on the same assignment: what they cost, and what they let through."""

FUNCTIONS = ("residual", "jacobian", "information_matrix", "gauss_newton_step")
