"""Sleeves around beams: two hoopings, the cut pieces between them, and what they do."""
