"""The page: blocks and sections, and the templates that show them."""
