"""What an array does when its current flows, from a specification to files."""
