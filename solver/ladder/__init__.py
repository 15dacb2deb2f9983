"""The ladder: from a law in microseconds to a mesh of everything."""
