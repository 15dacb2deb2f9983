"""Sparse finite elements: triangles for the fabric, a discrete rod for each wire."""
