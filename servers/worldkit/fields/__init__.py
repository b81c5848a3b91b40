"""Laws of fields and heat, as functions of arrays: magnets, soft iron, eddy currents, charges, temperatures.

`poles` makes magnets of magnetic charges, `magnetism` is what they do to each other and to soft iron, `eddies` what they induce in tubes
and plates, `coulomb` charges, `lumped_heat` bodies that warm and cool, `expansion` those that grow by it. The solvers of the same names beside the engine
(`worldengine.solvers`) read shapes from a world and push its bodies by them. World frame, SI units.
"""

MU0 = 1.25663706127e-6
"""N/A^2, CODATA 2022."""
EPSILON0 = 8.8541878188e-12
"""F/m, CODATA 2022."""
