"""What this package raises."""


class SceneError(ValueError):
    """A scene outside what the model or the method allows; the message names the limit."""


class NotConvergedError(RuntimeError):
    """No minimum was reached; the message says how far the solve got and what to try."""
