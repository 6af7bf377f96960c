"""Wheel and rail, their roughness as people have it: levels, lines, profiles."""
