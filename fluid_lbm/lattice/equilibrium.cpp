#include "fluid_lbm/lattice/equilibrium.h"

#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

double flow_population(int q, const LocalFlow& flow, double relaxation_time) {
    const double density = 1 + flow.density_excess;
    double cu = 0, uu = 0, strain = 0;
    for (int a = 0; a < 3; ++a) {
        cu += d3q19::c[q][a] * flow.velocity[a];
        uu += flow.velocity[a] * flow.velocity[a];
        for (int b = 0; b < 3; ++b) {
            const double cc = d3q19::c[q][a] * d3q19::c[q][b] - (a == b ? d3q19::cs2 : 0);
            strain += cc * flow.gradient[a][b];
        }
    }
    const double equilibrium =
        flow.density_excess + density * (3 * cu + 4.5 * cu * cu - 1.5 * uu);
    return d3q19::weight(q) * (equilibrium - 3 * density * relaxation_time * strain);
}

}  // namespace magfsi::fluid
