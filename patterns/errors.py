"""What this package raises."""


class PatternError(ValueError):
    """A layout, circuit or plan that cannot be made; the message says why and what would do."""
