"""The report of stiff and extreme cases."""
