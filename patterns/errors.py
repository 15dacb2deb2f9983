"""What this package raises."""


class PatternError(ValueError):
    """A layout, circuit or plan that cannot be made; the message says why and what would do."""


class NoRoomError(PatternError):
    """The needle finds no place beside the wire; larger loops may have one."""
