"""The report of the pendulum."""
