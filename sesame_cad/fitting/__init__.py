"""From what an array should do to the loops and wires that do it."""
