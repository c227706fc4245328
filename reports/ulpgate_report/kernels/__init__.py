"""The report of the DEM kernels."""
