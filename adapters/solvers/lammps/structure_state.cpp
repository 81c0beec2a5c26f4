// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/structure_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "adapters/scene/reader.h"
#include "coupler/checkpoint/rank_rows.h"
#include "coupler/checkpoint/state_file.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/kept_pairs.h"
#include "structure/rigid_motion.h"

namespace magfsi::lammps {

namespace {

using coupler::StateReader;
using coupler::StateWriter;

// Numbers of a rigid part.
constexpr std::size_t rigid_width = structure::RigidMotion::state_values;

// Name of the table of an array of the markers.
std::string table_of(const coupler::MarkerArray& array) {
    return "marker_" + array.name;
}

// Saves each rank's share of some sums as a row of the table. Collective.
void save_shares(MPI_Comm comm, const char* table, std::span<const double> mine,
                 StateWriter* file) {
    const auto all = coupler::gather_shares(comm, mine);
    if (file && !mine.empty())
        file->table(table, all, {all.size() / mine.size(), mine.size()});
}

// Saves the arrays of the markers in the order of their placement, independent of the
// number of ranks. Collective.
void save_markers(const StructureRun& run, StateWriter* file) {
    coupler::StructureCoupling& coupling = *run.coupling;
    for (const auto& array : coupling.carried()) {
        const auto all =
            coupler::gather_rows(run.session.world().local(), coupling.placed_index(),
                                 array.values, 3, coupling.placed());
        if (file) file->table(table_of(array), all, {coupling.placed(), 3});
    }
    const auto numbers = coupling.carried_numbers();
    if (file) file->table("numbers", numbers, {numbers.size()});
}

// The values of a table. Throws coupler::StateFault unless it has so many rows of this
// width, those of this run.
std::vector<double> rows_of(const StateReader& file, const std::string& table,
                            std::size_t rows, std::size_t width) {
    const auto shape = file.shape(table);
    if (shape != std::vector{rows, width}) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's table {} is {} x {}, this run's {} x "
            "{}: a mesh file or another build's markers differ; start without --restart",
            table, shape[0], shape.size() > 1 ? shape[1] : 0, rows, width));
    }
    return file.table(table);
}

// This rank's share of a table that save_shares wrote, also on another number of ranks.
std::vector<double> share(const StateReader& file, const char* table, MPI_Comm comm) {
    return coupler::share_of(comm, file.table(table), file.shape(table)[0]);
}

}  // namespace

void save_text(StateWriter& file, const std::string& table, const std::string& text) {
    if (text.empty()) return;
    const std::vector<double> numbers(text.begin(), text.end());
    file.table(table, numbers, {numbers.size()});
}

std::string text_in(const StateReader& file, const std::string& table) {
    std::string text;
    if (!file.has(table)) return text;
    for (const double number : file.table(table)) text += static_cast<char>(number);
    return text;
}

namespace {

// The field that a controller had set; empty if it had not been called yet.
std::optional<structure::FieldProgram> steered(const StructureRun& run,
                                               const StateReader& file,
                                               const char* table) {
    const std::string text = text_in(file, table);
    if (text.empty()) return {};
    return scene::read_field(text, "the controller's field in the checkpoint", run.scene);
}

}  // namespace

// Tables: nodes, sums (of the fixes), pairs, rigid, marker_NAME, numbers, balance,
// force_sums, substeps, energy_audit, and those of the controller. Those that the run
// does not need are absent.
void save_structure(const StructureRun& run, StateWriter* file) {
    const MPI_Comm comm = run.session.world().local();
    Engine& engine = *run.engine;
    const std::size_t atoms = run.atoms;
    const std::size_t width = engine.node_values();
    const std::vector<double> nodes = engine.gather_nodes(run.atoms);
    if (file) file->table("nodes", nodes, {atoms, width});
    save_shares(comm, "sums", engine.fix_sums(), file);
    const std::vector<double> pairs = engine.pairs();
    if (file && !pairs.empty()) {
        constexpr std::size_t row = structure::KeepsPairs::row_values;
        file->table("pairs", pairs, {pairs.size() / row, row});
    }
    const std::vector<double> rigid = engine.rigid_states();
    if (file && !rigid.empty())
        file->table("rigid", rigid, {rigid.size() / rigid_width, rigid_width});
    if (run.coupling) save_markers(run, file);
    if (run.balance()) save_shares(comm, "balance", run.balance()->values(), file);
    if (file && run.force_sums.time_s > 0) {
        std::vector<double> sums{run.force_sums.time_s};
        for (const auto& impulse : run.force_sums.impulse_n_s)
            sums.insert(sums.end(), impulse.begin(), impulse.end());
        file->table("force_sums", sums, {sums.size()});
    }
    if (file)
        file->table("substeps",
                    run.counted.carried(run.session.clock().step(), run.substeps.count),
                    {3});
    if (run.audit && file) {
        const auto carried = run.audit->carried();
        file->table("energy_audit", carried, {carried.size()});
    }
    if (run.save_control) run.save_control(file);
}

// Nodes and fixes are restored in the field of the checkpoint's last step, since forces
// and the field's work continue from there; the field that the controller set after that
// step follows at the end.
void restore_bodies(StructureRun& run, const StateReader& file) {
    Engine& engine = *run.engine;

    if (const auto before = steered(run, file, "field_of_step")) set_field(run, *before);
    const auto nodes = rows_of(file, "nodes", run.atoms, engine.node_values());
    engine.put_nodes(nodes);
    if (file.has("sums"))
        engine.put_fix_sums(share(file, "sums", run.session.world().local()));
    engine.put_pairs(file.has("pairs") ? file.table("pairs") : std::vector<double>{});
    if (const std::size_t values = engine.rigid_states().size(); values > 0)
        engine.put_rigid_states(
            rows_of(file, "rigid", values / rigid_width, rigid_width));
    if (run.audit) run.audit->set(file.table("energy_audit"));
    if (file.has("force_sums")) {
        const auto sums = file.table("force_sums");
        run.force_sums.time_s = sums.at(0);
        for (std::size_t i = 1; i + 3 <= sums.size(); i += 3)
            run.force_sums.impulse_n_s.push_back({sums[i], sums[i + 1], sums[i + 2]});
    }
    if (const auto now = steered(run, file, "field")) set_field(run, *now);
}

// A retry continues with shorter steps than the checkpoint's: the last step counts as
// shortened by the ratio of the two.
void restore_coupling(const StructureRun& run, const StateReader& file) {
    coupler::StructureCoupling& coupling = *run.coupling;
    if (file.has("numbers")) coupling.make_room(file.table("numbers"));
    const auto index = coupling.placed_index();
    for (const auto& array : coupling.carried()) {
        const auto all = rows_of(file, table_of(array), coupling.placed(), 3);
        for (std::size_t m = 0; m < index.size(); ++m) {
            const double* row = all.data() + 3 * static_cast<std::size_t>(index[m]);
            std::copy_n(row, 3, array.values.data() + 3 * m);
        }
    }
    const auto ratio = file.header().steps_in_one(run.session.clock().step_s());
    if (ratio > 1) coupling.shorten_last_step(1.0 / ratio);
    if (run.balance() && file.has("balance"))
        run.balance()->set(share(file, "balance", run.session.world().local()));
}

std::optional<structure::Vec3> StructureRun::field_t(double time_s) const {
    if (!steered) return {};
    return structure::field_at(*steered, time_s);
}

void set_field(StructureRun& run, const structure::FieldProgram& law) {
    run.engine->command("fix_modify field law " + structure::field_arguments(law));
    run.steered = law;
}

}  // namespace magfsi::lammps
