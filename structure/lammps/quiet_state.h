// How far a body is from equilibrium.
#pragma once

namespace magfsi::structure {

// Over the nodes of a group. The force on a node is all that accelerates it; the load is
// that without the elastic force (weight, field, contact, fluid).
struct QuietState {
    double largest_force_n = 0;
    double largest_load_n = 0;

    // Zero without any force; infinite where forces are left and no load is.
    double ratio() const {
        return largest_force_n > 0 ? largest_force_n / largest_load_n : 0;
    }
};

}  // namespace magfsi::structure
