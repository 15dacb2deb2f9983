"""A row of loops held short on a beam: its force, its couple, and the segment that it snaps."""
