"""Fabrication CAD for strained elastic surfaces with adjustable-modulus edges."""
