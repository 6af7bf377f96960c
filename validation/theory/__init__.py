"""Closed forms and linear theory: what is known without either method."""
