"""What figures of several subjects share: the look, heat maps, scales."""
