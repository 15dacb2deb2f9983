"""Why a solve on meshes ended without a shape to rely on."""

from __future__ import annotations

from solver.mesh.contact_energy import ContactEnergy
from solver.mesh.descent import Solved
from solver.mesh.problem import MeshProblem


def fault(problem: MeshProblem, solved: Solved, *, slack: bool) -> str:
    """Say which limit a solve met, and on what scene; ``"converged"`` when it met none.

    Parameters
    ----------
    slack : bool
        Whether fabric is compressed somewhere, or wrinkled instead.
    """
    minimum = solved.minimum
    if minimum.converged:
        return "converged"
    saddle = f" and {minimum.negative} negative eigenvalues" if minimum.negative else ""
    return (
        f"not converged after {minimum.steps} steps {_limit(solved)}: a gradient of "
        f"{minimum.gradient_norm:.1e}{saddle} is left, at beta = {_betas(problem)} and strain = "
        f"{problem.strain:.3g}{_cause(problem, slack=slack)}; raise beta or lower strain"
    )


def _limit(solved: Solved) -> str:
    minimum = solved.minimum
    touching = " with contact" if isinstance(solved.energy, ContactEnergy) else ""
    if minimum.steps >= minimum.most_steps:
        return f"of at most {minimum.most_steps}{touching}"
    return f"{touching}, which no longer led down".removeprefix(" ")


def _betas(problem: MeshProblem) -> str:
    """Give β of all wires, in the solve's unit of length."""
    least, most = (bound(wire.beta for wire in problem.wires) for bound in (min, max))
    return f"{least:.3g}" if least == most else f"{least:.3g} to {most:.3g}"


def _cause(problem: MeshProblem, *, slack: bool) -> str:
    """Say what slack fabric does; nothing where all of it is taut."""
    if not slack or problem.strain == 0:
        return ""
    if problem.tension_field:
        return ", where slack fabric is next to free to move"
    return ", where slack fabric wrinkles at the mesh's scale without a tension field"
