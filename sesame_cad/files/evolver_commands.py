"""What a Surface Evolver datafile of a loop says besides its mesh."""

HEAD = """\
// A SESAME: {loops} of wire on fabric that was stretched when the wire was sewn on.
// For Surface Evolver 2.70. Run evolver with this file, then type at its prompt:
//     solve     finds the shape and prints it
//     report    prints height and energies of the present shape
// To try another wire, set wire_bending or wire_stiffness (below) at the prompt and solve again.
//
// Lengths are in units of R; the loops' mean length, flat, is 2 pi R times {size}. Energies are
// in units of E_f t R^2, with E_f the fabric's modulus and t its thickness. For millimetres and
// millijoules multiply by these.
//
//     strain            {strain}, of the fabric in the hoop
//     poisson           {poisson}, of the fabric ({reading} reading)
//     beta              {beta} = E_w I_w / (2 E_f t R^3), bending of the wire
//     axial_stiffness   {axial_stiffness} = E_w A_w / (E_f t R), stretch of the wire
//     triangles         {triangles}
"""

SEVERAL_WIRES = """\
// wire_bending and wire_stiffness are the first wire's. Each wire's own are bend_share_0 (1, 2 ...)
// times that at its vertices, and stretch_share times that along its edges.
"""

TOUCHING = """\
// Wires that touch share the point of contact, but may turn about it: Evolver has no bond that
// keeps their tangents parallel. Sewn side by side they cannot, so that real shapes have more
// energy.
"""

DECLARATIONS = """\
parameter wire_bending = {beta}              // beta
parameter wire_stiffness = {axial_stiffness}     // axial_stiffness

define vertex attribute on_wire integer
define edge attribute hooke_size real                // length of the unstretched edge / R
define edge attribute sqcurve_string_mark integer    // not 0: an edge of a wire
define facet attribute poisson_ratio real
define facet attribute form_factors real[3]          // u.u, u.v, v.v of the unstretched sides

// Fabric: St. Venant-Kirchhoff, modulus / (2 (1+p)) (Tr E^2 + p/(1-p) (Tr E)^2) times the
// unstretched area, with p the poisson_ratio at each face. For the plane-stress reading p is
// Poisson's ratio nu and the modulus 1; for the published one p = nu/(1-nu) and the modulus
// 2 (1+p)/(1+nu). The stretch in the hoop is in the form_factors.
quantity fabric energy modulus {modulus} method linear_elastic global

// Bending of the wire: modulus * turn^2 / (half the length of both edges) at each vertex on it.
// The plain sqcurve_string would take two edges of the fabric; the mark tells which are the wire's.
// Where wires touch, each has a bit of the mark for itself.
// Stretch of the wire: modulus/2 * (length - hooke_size)^2 / hooke_size for each edge of it.
"""

BEND_SHARE = "define vertex attribute bend_share_{0} real\n"
STRETCH_SHARE = "define edge attribute stretch_share real\n"
BEND = "quantity bend energy modulus wire_bending method sqcurve_string_marked{share}\n"
BEND_SOME = "method_instance bend_{0} method sqcurve_string_marked{share} parameter_2: {bit}\n"
STRETCH = "quantity stretch energy modulus wire_stiffness method hooke3_energy{share}\n"

PINS = """\
// Pins against drifting and turning, as few as the motions that cost nothing, so that they hold no
// force and change neither shape nor energy.
"""

LEVELLING = """\
// Loops that hang together by points alone are free to hinge there. Of all those shapes, springs
// that are too weak to bend a loop pick one near the plane: pull/2 * z^2 at each vertex.
define vertex attribute pull real
quantity levelling energy modulus 0.5 method vertex_scalar_integral element_modulus pull global
scalar_integrand: z^2
"""

BENDING_FABRIC = """\
parameter fabric_stiffness = {alpha}         // alpha

// Bending of the fabric: modulus times the integral of H^2 over the surface, H = (k1 + k2)/2, from
// the stars of the inner vertices. At the fabric's edge, free to turn about its wire, H is 0. The
// plain sq_mean_curvature has no Hessian.
quantity fabric_bend energy modulus fabric_stiffness method star_perp_sq_mean_curvature
"""

FURTHER = "  // further terms\n"
"""Where the report prints the energies of quantities that not every datafile has."""

FURTHER_TERM = '  printf "energy_{name} %.10g\\n", {quantity}.value;\n'

FURTHER_ADVICE = "    // further advice\n"
"""Where the verdict tells why there may be no minimum but for slack fabric."""

HINGE_ADVICE = """\
    printf "  loops that touch in points turn there at next to no cost: the energy is known to\\n";
    printf "  a few digits, the height is one of many\\n";
"""

COMMANDS = """
read

// Vertices may move sideways too; with normal motion alone a flat loop would not shrink or buckle.
hessian_normal off
suppress_warning 1825        // says at each saddle point that it is one
SOFT_WIRE := 30              // stiffness to begin with: a stiff wire keeps long steps from buckling
LARGEST_STEPS := 300
SMALL_CHANGE := 1e-11        // of the energy, relative; a minimum's error in shape is its root
step_count := 0
negatives := 0
change := 1.0
energy_before := 0.0

// One step of Newton's method with a search along it. Where that stands still though the energy
// falls another way (a saddle point of the energy, such as the flat loop), leave along that way.
newton_step := {
  energy_before := total_energy;
  hessian_seek 10;
  negatives := eigenneg;
  change := abs(energy_before - total_energy)/abs(total_energy);
  step_count := step_count + 1;
  if ( negatives > 0 and change < 1e-4 ) then saddle;
}

// Both rows of steps end when little changes and no way leads down.
rough_steps := {
  do { newton_step; }
  while ( (change > 1e-3 or negatives > 0) and step_count < LARGEST_STEPS/3 );
}
fine_steps := {
  do { newton_step; }
  while ( (change > SMALL_CHANGE or negatives > 0) and step_count < LARGEST_STEPS );
}

// Two plain steps of Newton's method double the digits twice; then the ways down are counted again,
// but for turns in the mesh that cost next to nothing.
polish := {
  energy_before := total_energy;
  { hessian; } 2;
  change := abs(energy_before - total_energy)/abs(total_energy);
  eigenprobe -1e-8;
  negatives := eigenneg;
}

verdict := {
  if ( change < 10*SMALL_CHANGE and negatives == 0 ) then
    printf "converged after %d steps\\n", step_count
  else {
    printf "NOT converged after %d steps: relative change of energy %g, ways down %d\\n",
      step_count, change, negatives;
    printf "  slack fabric wrinkles as finely as its mesh: fewer refinements, or a larger beta\\n";
    // further advice
  };
}

// The height is measured along the mean normal of the loop, since a saddle may turn a little in
// its mesh and then stands tilted on the pins.
report := {
  normal_x := sum(facet ff, ff.facet_normal[1]);
  normal_y := sum(facet ff, ff.facet_normal[2]);
  normal_z := sum(facet ff, ff.facet_normal[3]);
  normal_length := sqrt(normal_x^2 + normal_y^2 + normal_z^2);
  highest := max(vertex vv where vv.on_wire, vv.x*normal_x + vv.y*normal_y + vv.z*normal_z);
  lowest := min(vertex vv where vv.on_wire, vv.x*normal_x + vv.y*normal_y + vv.z*normal_z);
  printf "height_over_perimeter %.10g\\n", (highest - lowest)/normal_length/(2*pi);
  printf "energy %.13g\\n", total_energy;
  printf "energy_fabric %.10g\\n", fabric.value;
  printf "energy_wire_bending %.10g\\n", bend.value;
  printf "energy_wire_stretch %.10g\\n", stretch.value;
  // further terms
}

solve := {
  quiet on;
  step_count := 0;
  bend.modulus := wire_bending; stretch.modulus := wire_stiffness; recalc;
  if ( wire_stiffness > SOFT_WIRE ) then {
    stretch.modulus := SOFT_WIRE; recalc;
    g 5;
    rough_steps;
    stretch.modulus := wire_stiffness; recalc;
  };
  fine_steps;
  polish;
  while ( negatives > 0 and step_count < LARGEST_STEPS ) do { saddle; fine_steps; polish; };
  verdict;
  report;
  quiet off;
}
"""
