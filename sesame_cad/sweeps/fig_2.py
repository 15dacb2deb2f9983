"""The sweep that is made when nothing else is asked: Fig. 2 of the paper."""

from __future__ import annotations

from types import MappingProxyType

FIG_2 = MappingProxyType(
    {
        "strain": "0:0.5:26",
        "beta": "0.01:0.25:25",
        "poisson": "0.446",
        "axial_stiffness": "1000",
        "reading": "published",
    }
)
"""The paper's Fig. 2; of Poisson's ratio, which it does not give, that which gives its heights."""
