// SPDX-License-Identifier: GPL-2.0-or-later
// A stiff square sheet on a spring swings in the fluid of sheet.yaml, slowed by the water it moves.
#include <cmath>

#include "adapters/structure_program.h"
#include "coupler/participants/errors.h"

using namespace magfsi;
using Nodes = std::vector<std::array<double, 3>>;

class SpringSheet : public coupler::StructureSolver {
  public:
    static constexpr int n = 17, substeps = 20;  // nodes along a side
    static constexpr double side = 4e-3, mass = 1e-6, spring = 0.3, start = 2e-4;  // SI
    SpringSheet(const scene::Vec3& box, double step) : substep_(step / substeps) {
        for (int i = 0; i < n * n; ++i)
            rest_.push_back({box[0] / 2 + side * ((i % n + 0.5) / n - 0.5),
                             box[1] / 2 + side * ((i / n + 0.5) / n - 0.5), box[2] / 2});
        at_ = rest_, speed_ = Nodes(at_.size());
        for (auto& x : at_) x[2] += start;
    }
    void advance() override {
        for (int s = 0; s < substeps; ++s) {
            Nodes force(at_.size());
            fluid_(speed_[0].data(), force[0].data(), substep_);
            double sum = spring * (rest_[0][2] - at_[0][2]);  // it moves as one, across its plane
            for (const auto& f : force) sum += f[2];
            const double speed = speed_[0][2] + substep_ * sum / mass;
            for (std::size_t i = 0; i < at_.size(); ++i) at_[i][2] += substep_ * (speed_[i][2] = speed);
        }
    }
    double deflection() const { return at_[0][2] - rest_[0][2]; }
    const double* positions() const override { return at_[0].data(); }
    const double* velocities() const override { return speed_[0].data(); }
    void renew_ghost_velocities() override {}  // one rank has no ghosts
    void attach_fluid_force(NodalForce force) override { fluid_ = std::move(force); }
    void check_finite(std::int64_t) const override {
        if (!std::isfinite(deflection())) throw coupler::Diverged("the sheet is gone");
    }
    void keep() override { kept_ = {at_, speed_}; }  // for coupling.scheme: implicit
    void go_back() override { at_ = kept_[0], speed_ = kept_[1]; }

  private:
    double substep_;
    Nodes rest_, at_, speed_;
    std::array<Nodes, 2> kept_;
    NodalForce fluid_;
};

int main(int argc, char** argv) {
    return run_structure("A sheet on springs", argc, argv, [](const scene::Scene& scene, double step) {
        auto sheet = std::make_unique<SpringSheet>(scene.fluid->box_m, step);
        OwnStructure own{nullptr, {}, {"deflection[m]"}, [s = sheet.get()] { return std::vector{s->deflection()}; }};
        const double share = std::pow(SpringSheet::side / SpringSheet::n, 2) * scene.fluid->spacing_m;
        for (int i = 0; i < SpringSheet::n * SpringSheet::n; ++i) own.markers.push_back(node_marker(i, share));
        own.solver = std::move(sheet);
        return own;
    });
}
