// SPDX-License-Identifier: GPL-2.0-or-later
// A structure participant with one solver and one set of markers; magfsi-structure
// (adapters/lammps) is the same for bodies of a scene.
#include "adapters/structure_program.h"

#include <numeric>

#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/solvers/fluids/fluid_probes.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/waiting.h"
#include "coupler/step/report.h"

namespace magfsi {

namespace {

// Numbers the markers of all ranks consecutively by rank. Collective over `comm`.
coupler::BodyMarkers numbered(std::vector<coupler::Marker> markers, MPI_Comm comm) {
    coupler::BodyMarkers mine;
    const int count = markers.size();
    int end = 0, all = 0;
    MPI_Scan(&count, &end, 1, MPI_INT, MPI_SUM, comm);
    MPI_Allreduce(&count, &all, 1, MPI_INT, MPI_SUM, comm);
    mine.placed_index.resize(markers.size());
    std::iota(mine.placed_index.begin(), mine.placed_index.end(), end - count);
    mine.placed = all;
    mine.markers = std::move(markers);
    mine.bodies = 1;
    return mine;
}

// The structure participant around the user's solver: coupling, probes and progress.
class Participant {
  public:
    // The fluid sends the description of its grid during the start, and the markers are
    // set up for that grid.
    Participant(const scene::Scene& scene, coupler::Session& session, OwnStructure own,
                output::ProgressMode mode)
        : scene_(scene),
          session_(session),
          own_(std::move(own)),
          coupling_(coupler::make_structure_coupling(
              session, *own_.solver,
              coupler::grid_from_text(coupler::swap_text(
                  session.world(), "", coupler::no_timeout_s, "description of the grid")),
              numbered(std::move(own_.markers), session.world().local()))) {
        coupling_->add_tasks(tasks_);
        if (scene.probes) add_probes();
        if (!session.world().leads()) return;
        progress_ = coupler::progress_on_stdout(session, mode);
        tasks_.add_output("progress",
                          [this] { progress_->update(session_.clock().step()); });
    }

    // Log, first exchange, probes at time 0, then all steps and the summary.
    void run() {
        coupler::log_effects(session_);
        coupler::log_steps(session_, tasks_);
        coupling_->begin();
        if (scene_.probes) write_probes();
        const double start = output::steady_seconds();
        while (session_.running()) tasks_.run();
        finish(output::steady_seconds() - start);
    }

  private:
    // Columns: the user's, then the fluid's. Rows follow at whole coupled steps.
    void add_probes() {
        fluid_columns_ = fluids::fluid_columns(scene_);
        std::vector<std::string> columns = own_.columns;
        columns.insert(columns.end(), fluid_columns_.begin(), fluid_columns_.end());
        if (session_.world().leads()) probes_ = coupler::open_probes(session_, columns);
        const auto every = session_.clock().every(scene_.probes->every_s);
        tasks_.add_output("probes", [this, every] {
            if (session_.clock().step() % every == 0) write_probes();
        });
    }

    // Root only: its own values, then the fluid's, which the fluid sends each time.
    void write_probes() {
        if (!session_.world().root()) return;
        std::vector<double> row = own_.values ? own_.values() : std::vector<double>();
        if (!fluid_columns_.empty()) {
            std::vector<double> of_fluid(fluid_columns_.size());
            coupler::receive_numbers(session_.world(), session_.clock().step(), of_fluid,
                                     session_.timeout_s());
            row.insert(row.end(), of_fluid.begin(), of_fluid.end());
        }
        probes_->row(session_.clock().time_s(), row);
    }

    // Collective: every rank contributes to the report. The leading rank writes the
    // summary.
    void finish(double wall_s) {
        std::vector<coupler::ParticipantReport> reports{
            coupler::basic_report(session_.world(), tasks_)};
        const auto boundary =
            coupler::boundary_summary(coupling_->slip(), session_.plan().given_speed_m_s);
        reports.front().add(boundary);
        reports.push_back(coupler::receive_report(session_));
        if (!session_.world().leads()) return;
        progress_->finish(session_.clock().step());
        coupler::write_summary(session_, reports, wall_s, probes_.get());
        session_.log(coupler::end_line(session_, wall_s));
    }

    const scene::Scene& scene_;
    coupler::Session& session_;
    OwnStructure own_;
    std::unique_ptr<coupler::StructureCoupling> coupling_;
    coupler::TaskList tasks_;
    std::vector<std::string> fluid_columns_;
    std::unique_ptr<output::ProbeFile> probes_;  // on the leading rank
    std::unique_ptr<output::Progress> progress_;
};

}  // namespace

// The marker's whole weight is on its first node; the other entries repeat the node with
// weight 0.
coupler::Marker node_marker(int node, double volume_m3) {
    coupler::Marker marker;
    marker.node.fill(node);
    marker.weight[0] = 1;
    marker.volume_m3 = volume_m3;
    return marker;
}

// The coupled step is that of the scene: a structure of the user's own has no substeps
// that could set it.
int run_structure(const std::string& description, int argc, char** argv,
                  const MakeStructure& make) {
    return run_scene(
        coupler::Role::structure, description, argc, argv,
        [&](const scene::Scene& scene, coupler::Session& session,
            const coupler::ParticipantArguments& arguments) {
            if (!scene.fluid)
                throw std::invalid_argument(
                    "the scene has no fluid; a structure of your own needs the key "
                    "fluid");
            const double step_s = *scene::coupled_step_s(scene);
            session.begin(step_s);
            Participant(scene, session, make(scene, step_s), arguments.progress).run();
        });
}

}  // namespace magfsi
