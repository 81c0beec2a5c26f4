#include "adapters/lbm/fluid_probes.h"

namespace magfsi::lbm {

std::vector<double> probe_values(const std::vector<scene::FluidQuantity>& quantities,
                                 const fluid::Fluid& fluid) {
    const fluid::Totals totals = fluid.totals();
    std::vector<double> values;
    for (const auto quantity : quantities) {
        switch (quantity) {
            case scene::FluidQuantity::kinetic_energy:
                values.push_back(totals.kinetic_energy_j);
                break;
            case scene::FluidQuantity::enstrophy:
                values.push_back(totals.enstrophy_1_s2);
                break;
            case scene::FluidQuantity::mass:
                values.push_back(totals.mass_kg);
                break;
            case scene::FluidQuantity::max_speed:
                values.push_back(totals.max_speed_m_s);
                break;
        }
    }
    return values;
}

}  // namespace magfsi::lbm
