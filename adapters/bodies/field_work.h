// Work of the uniform field along a path of equilibria.
#pragma once

#include <span>
#include <vector>

#include "structure/body.h"

namespace magfsi::bodies {

// sum over the path of q_a (B_before + B_after)/2 . (x_after - x_before), q_a the nodes'
// charges: a property of the equilibria, whatever motion leads from one to the next.
class FieldWork {
  public:
    // Where the body is before any load. `let_go`: moves to the first equilibrium in the
    // field at full strength; else the field is raised from zero on the way.
    FieldWork(const structure::Body& body, std::vector<structure::Vec3> placed_m,
              bool let_go);

    void move_to(std::span<const structure::Vec3> nodes_m,
                 const structure::Vec3& field_t);
    double work_j() const { return work_j_; }

  private:
    std::vector<double> charge_a_m_;
    std::vector<structure::Vec3> nodes_m_;
    structure::Vec3 field_t_{};
    bool let_go_;
    double work_j_ = 0;
};

// Whether a body is let go at the start of its path: one that nothing holds, or a relaxed
// one.
bool is_let_go(const structure::Body& body, const structure::Placement& initial);

}  // namespace magfsi::bodies
