"""Mechanics of strained elastic surfaces with adjustable-modulus edges."""
