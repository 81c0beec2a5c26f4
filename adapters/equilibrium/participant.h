// The bodies of a scene without motion: equilibria along the path of loads.
#pragma once

#include <memory>

#include "adapters/bodies/structure_files.h"
#include "adapters/equilibrium/load_path.h"
#include "coupler/output/probe_file.h"
#include "coupler/output/log.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::equilibrium {

class Participant {
  public:
    // After session.begin.
    Participant(const scene::Scene& scene, coupler::Session& session, output::ProgressMode progress);
    void run();

  private:
    void assemble(output::ProgressMode progress);
    void advance();
    void report_branch(const LoadPath& path);
    void write_probes();
    void write_fields();
    bodies::NodalState state() const;
    void finish(double wall_s);

    const scene::Scene& scene_;
    coupler::Session& session_;
    double start_s_ = output::steady_seconds();  // the first equilibrium is found at once
    std::vector<std::unique_ptr<LoadPath>> paths_;  // one a body
    coupler::TaskList tasks_;
    int iterations_ = 0;
    // Present only when the scene names them:
    std::unique_ptr<bodies::ProbeRow> probe_row_;
    std::unique_ptr<output::ProbeFile> probes_;
    std::unique_ptr<bodies::StructureFiles> files_;
    std::unique_ptr<output::Progress> progress_;
};

}  // namespace magfsi::equilibrium
