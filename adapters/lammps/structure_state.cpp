#include "adapters/lammps/structure_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "coupler/checkpoint/state_file.h"

namespace magfsi::lammps {

namespace {

using coupler::StateReader;
using coupler::StateWriter;

std::string table_of(const BodyCoupling::MarkerArray& array) {
    return "marker_" + array.name;
}

void save_shares(MPI_Comm comm, const char* table, std::span<const double> mine,
                 StateWriter* file) {
    const auto all = coupler::gather_shares(comm, mine);
    if (file && !mine.empty())
        file->table(table, all, {all.size() / mine.size(), mine.size()});
}

void save_markers(const StructureParts& parts, StateWriter* file) {
    BodyCoupling& coupling = *parts.coupling;
    for (const auto& array : coupling.carried()) {
        const auto all =
            coupler::gather_rows(parts.session.world().local(), coupling.placed_index(),
                                 array.values, 3, coupling.placed());
        if (file) file->table(table_of(array), all, {coupling.placed(), 3});
    }
    const auto numbers = coupling.carried_numbers();
    if (file) file->table("numbers", numbers, {numbers.size()});
}

void broadcast(std::vector<double>& values, std::size_t size, MPI_Comm comm) {
    values.resize(size);
    MPI_Bcast(values.data(), static_cast<int>(size), MPI_DOUBLE, 0, comm);
}

// Rows of a table, checked against what this run has.
std::vector<double> rows_of(const StateReader& file, const std::string& table,
                            std::size_t rows, std::size_t width) {
    const auto shape = file.shape(table);
    if (shape != std::vector{rows, width}) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's table {} is {} x {}, this run's {} x "
            "{}: a mesh file or another build's markers differ",
            table, shape[0], shape.size() > 1 ? shape[1] : 0, rows, width));
    }
    return file.table(table);
}

std::vector<double> share(const StateReader& file, const char* table, MPI_Comm comm) {
    return coupler::share_of(comm, file.table(table), file.shape(table)[0]);
}

}  // namespace

void save_structure(const StructureParts& parts, StateWriter* file) {
    const MPI_Comm comm = parts.session.world().local();
    Engine& engine = parts.engine;
    const auto atoms = static_cast<std::size_t>(parts.atoms);
    const std::size_t width = engine.node_values();
    std::vector<double> nodes = engine.gather_nodes(parts.atoms);
    if (file) file->table("nodes", nodes, {atoms, width});
    save_shares(comm, "sums", engine.fix_sums(), file);
    if (parts.coupling) save_markers(parts, file);
    if (parts.balance) save_shares(comm, "balance", parts.balance->values(), file);
    if (file)
        file->table("substeps",
                    parts.counted->carried(parts.session.clock().step(), parts.substeps),
                    {3});
    if (parts.audit && file) {
        const auto carried = parts.audit->carried();
        file->table("energy_audit", carried, {carried.size()});
    }
    if (!parts.scene.contact) return;
    broadcast(nodes, atoms * width, comm);
    engine.renew_neighbours();
    engine.put_nodes(nodes);
}

void restore_bodies(const StructureParts& parts, const StateReader& file) {
    Engine& engine = parts.engine;
    const auto nodes = rows_of(file, "nodes", static_cast<std::size_t>(parts.atoms),
                               engine.node_values());
    engine.put_nodes(nodes);
    if (parts.scene.contact) {
        engine.renew_neighbours();
        engine.put_nodes(nodes);
    }
    if (file.has("sums"))
        engine.put_fix_sums(share(file, "sums", parts.session.world().local()));
    if (parts.audit) parts.audit->set(file.table("energy_audit"));
}

void restore_coupling(const StructureParts& parts, const StateReader& file) {
    BodyCoupling& coupling = *parts.coupling;
    if (file.has("numbers")) coupling.make_room(file.table("numbers"));
    const auto index = coupling.placed_index();
    for (const auto& array : coupling.carried()) {
        const auto all = rows_of(file, table_of(array), coupling.placed(), 3);
        for (std::size_t m = 0; m < index.size(); ++m) {
            const double* row = all.data() + 3 * static_cast<std::size_t>(index[m]);
            std::copy_n(row, 3, array.values.data() + 3 * m);
        }
    }
    const auto ratio = file.header().steps_in_one(parts.session.clock().step_s());
    if (ratio > 1) coupling.shorten_last_step(1.0 / static_cast<double>(ratio));
    if (parts.balance && file.has("balance"))
        parts.balance->set(share(file, "balance", parts.session.world().local()));
}

}  // namespace magfsi::lammps
