"""What is given: bodies, roughness, measured heights, scene files."""
