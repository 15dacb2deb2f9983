"""How much of a shape-memory wire is austenite, by its temperature and by its past."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError

Values = NDArray[np.float64]

ABSOLUTE_ZERO_C = -273.15


def _rise(temperature_C: Values, low_C: float, high_C: float) -> Values:  # noqa: N803
    """From 0 to 1 between two temperatures along half a cosine."""
    share = np.clip((temperature_C - low_C) / (high_C - low_C), 0.0, 1.0)
    return (1 - np.cos(math.pi * share)) / 2


def _slope(temperature_C: Values, low_C: float, high_C: float) -> Values:  # noqa: N803
    """Derivative of `_rise`."""
    share = np.clip((temperature_C - low_C) / (high_C - low_C), 0.0, 1.0)
    return math.pi / 2 * np.sin(math.pi * share) / (high_C - low_C)


@dataclass(frozen=True, slots=True)
class Transformation:
    """The four transformation temperatures of nickel-titanium, and the law between them.

    Heated from martensite the fraction of austenite is f_A(T), half a cosine from As to Af; cooled
    from austenite it is f_M(T), half a cosine from Ms to Mf (Liang and Rogers, J. Intell. Mater.
    Syst. Struct. 1 (1990) 207). From any other state it stays as it is until it meets its branch:

        ξ = max(ξ0, f_A(T))  when heated,   ξ = min(ξ0, f_M(T))  when cooled,

    the play operator (Visintin, Differential Models of Hysteresis, 1994, ch. III): docs/theory.md,
    eq. (22). A wire that has turned back on its way comes to the same state again, and a pause
    changes nothing.

    Attributes
    ----------
    austenite_start_C, austenite_finish_C : float
        As < Af.
    martensite_start_C, martensite_finish_C : float
        Ms > Mf; neither above its austenite counterpart: Ms ≤ Af, Mf ≤ As.

    Raises
    ------
    SceneError
        When they are not in this order.
    """

    austenite_start_C: float  # noqa: N815 - the unit's own spelling
    austenite_finish_C: float  # noqa: N815
    martensite_start_C: float  # noqa: N815
    martensite_finish_C: float  # noqa: N815

    def __post_init__(self) -> None:
        for first, second, order in (
            ("austenite_start_C", "austenite_finish_C", "below"),
            ("martensite_finish_C", "martensite_start_C", "below"),
            ("martensite_finish_C", "austenite_start_C", "at most"),
            ("martensite_start_C", "austenite_finish_C", "at most"),
        ):
            low, high = float(getattr(self, first)), float(getattr(self, second))
            right = low < high or (low == high and order == "at most")
            if not (right and math.isfinite(low) and math.isfinite(high)):
                raise SceneError(f"{first} = {low:g}: must be {order} {second} = {high:g}")
            if low < ABSOLUTE_ZERO_C:
                raise SceneError(f"{first} = {low:g}: is below absolute zero")

    @property
    def temperatures_C(self) -> tuple[float, float, float, float]:  # noqa: N802
        """As, Af, Ms and Mf."""
        return (
            self.austenite_start_C,
            self.austenite_finish_C,
            self.martensite_start_C,
            self.martensite_finish_C,
        )

    def heated(self, temperature_C: Values | float) -> Values:  # noqa: N803
        """f_A: fraction of austenite when heated from martensite."""
        there = np.asarray(temperature_C, dtype=float)
        return _rise(there, self.austenite_start_C, self.austenite_finish_C)

    def cooled(self, temperature_C: Values | float) -> Values:  # noqa: N803
        """f_M: fraction of austenite when cooled from austenite."""
        there = np.asarray(temperature_C, dtype=float)
        return _rise(there, self.martensite_finish_C, self.martensite_start_C)

    def heated_to(self, fraction: float) -> float:
        """Temperature in °C at which a heating from martensite has this fraction of austenite."""
        low, high = self.austenite_start_C, self.austenite_finish_C
        return low + (high - low) * math.acos(1 - 2 * fraction) / math.pi

    def cooled_to(self, fraction: float) -> float:
        """Temperature in °C at which a cooling from austenite has this fraction left."""
        low, high = self.martensite_finish_C, self.martensite_start_C
        return low + (high - low) * math.acos(1 - 2 * fraction) / math.pi

    def along(
        self,
        fraction: float,
        start_C: float,  # noqa: N803
        temperature_C: Values,  # noqa: N803
    ) -> tuple[Values, Values]:
        """Follow a heating, or a cooling, from one state without turning back.

        Parameters
        ----------
        fraction : float
            ξ0 at the start.
        start_C : float
            T0.
        temperature_C : array (n,)
            Where to: none of them below T0, or none above.

        Returns
        -------
        fraction, slope : array (n,)
            ξ and dξ/dT.
        """
        # round-off at the start itself must not turn the way around
        lowest, highest = temperature_C.min(initial=start_C), temperature_C.max(initial=start_C)
        if start_C - lowest > highest - start_C:
            branch = self.cooled(temperature_C)
            slope = _slope(temperature_C, self.martensite_finish_C, self.martensite_start_C)
            return np.minimum(fraction, branch), np.where(branch < fraction, slope, 0.0)
        branch = self.heated(temperature_C)
        slope = _slope(temperature_C, self.austenite_start_C, self.austenite_finish_C)
        return np.maximum(fraction, branch), np.where(branch > fraction, slope, 0.0)

    def kinks_C(self, fraction: float) -> tuple[float, ...]:  # noqa: N802
        """Temperatures at which the way from a state may change its law."""
        return (*self.temperatures_C, self.heated_to(fraction), self.cooled_to(fraction))

    def after(self, fraction: float, start_C: float, end_C: float) -> float:  # noqa: N803
        """ξ after a heating or cooling to another temperature."""
        return float(self.along(fraction, start_C, np.array([end_C]))[0][0])
