"""Orders and energies of integrators, a part of the pendulum's report."""
