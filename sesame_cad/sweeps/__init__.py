"""One number varied, or several: what becomes of a loop or of a design over a whole grid."""
