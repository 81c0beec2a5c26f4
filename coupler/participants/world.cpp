// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <utility>
#include <vector>

#include "coupler/participants/errors.h"
#include "coupler/participants/processes.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

namespace {

constexpr int intercommunicator_tag = 71, controller_tag = 75;

// A process of the job, as all others learn of it.
struct Member {
    std::int64_t role = 0;
    std::uint64_t scene_hash = 0;
    std::array<char, 32> program{};
    ProcessId process;
};

// All processes of the job by world rank. Collective over the job.
std::vector<Member> members_of_world(Role self, std::uint64_t scene_hash) {
    Member mine{static_cast<int>(self), scene_hash, {}, this_process()};
    const std::string_view name = program_invocation_short_name;
    name.copy(mine.program.data(), mine.program.size() - 1);
    int world_size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &world_size);
    std::vector<Member> all(world_size);
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE,
                  MPI_COMM_WORLD);
    return all;
}

// Throws PartnerLost if a process of the same role runs another program or scene.
void check_own_side(Role self, const Member& mine, const std::vector<Member>& all) {
    for (const Member& other : all) {
        if (other.role != mine.role) continue;
        if (other.program != mine.program)
            throw PartnerLost(fmt::format(
                "{} and {} are both in this MPI job as the {}; start one of them",
                mine.program.data(), other.program.data(), to_string(self)));
        if (other.scene_hash != mine.scene_hash)
            throw PartnerLost(fmt::format(
                "the processes of the {} disagree on the scene (hash): {:016x} here, "
                "{:016x} there; start all with the same scene file and --set options",
                to_string(self), mine.scene_hash, other.scene_hash));
    }
}

// World rank of the first process of a role, or -1.
int first_rank(const std::vector<Member>& all, Role role) {
    const auto at = std::ranges::find(all, static_cast<int>(role), &Member::role);
    return at == all.end() ? -1 : static_cast<int>(at - all.begin());
}

}  // namespace

std::string to_string(Role role) {
    if (role == Role::control) return "controller";
    return role == Role::structure ? "structure" : "fluid";
}

World::World(Role self, bool partner_expected, std::uint64_t scene_hash,
             bool controller_expected)
    : self_(self), notifier_(this_process()) {
    const std::vector<Member> all = members_of_world(self, scene_hash);
    joined();
    int world_rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
    const Member& mine = all[world_rank];
    check_own_side(self, mine, all);
    processes_here_ = std::ranges::count(
        all, mine.process.machine, [](const Member& m) { return m.process.machine; });
    MPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(self), world_rank, &local_);
    MPI_Comm_rank(local_, &rank_);
    MPI_Comm_size(local_, &size_);
    join_partner(first_rank(all, other()), partner_expected);
    // The controller belongs to the structure; the fluid does not take part.
    const int controller = first_rank(all, Role::control);
    if (self == Role::structure) join_controller(controller, controller_expected);
    if (controller_ != MPI_COMM_NULL) controller_process_ = all[controller].process;
    Awaited awaited{.partner = to_string(other())};
    std::vector<ProcessId> partner;
    for (const Member& member : all) {
        const auto role = static_cast<Role>(member.role);
        if (role == other()) partner.push_back(member.process);
        if (role == other() || (role == Role::control && self == Role::structure))
            awaited.processes.push_back({member.process, to_string(role)});
    }
    if (coupled() && partner_notifies(partner)) awaited.notifier = &notifier_;
    set_awaited(std::move(awaited));
}

// Sockets of both sides exist since the first exchange, which every process makes after
// it has opened its own.
bool World::partner_notifies(const std::vector<ProcessId>& partner) {
    int reached = 1, reached_by_all = 0;
    for (const ProcessId& process : partner)
        if (!notifier_.notify(process)) reached = 0;
    if (reached != 0) notified_ = partner;
    // On an intercommunicator the result is that of the other side's processes.
    MPI_Allreduce(&reached, &reached_by_all, 1, MPI_INT, MPI_MIN, partner_);
    return reached_by_all != 0;
}

void World::send(const void* data, int count, MPI_Datatype type, int rank, int tag,
                 MPI_Request* request) const {
    MPI_Isend(data, count, type, rank, tag, partner_, request);
    if (!notified_.empty()) notifier_.notify(notified_[rank]);
}

void World::receive_from_root(void* data, int count, MPI_Datatype type, int tag,
                              double timeout_s, const std::string& what) const {
    constexpr std::array root{0};
    wait_for_messages(partner_, root, tag, timeout_s, what);
    MPI_Request request;
    MPI_Irecv(data, count, type, 0, tag, partner_, &request);
    wait_all({&request, 1}, timeout_s, what);
}

void World::join_partner(int first, bool expected) {
    if (first < 0 && expected) {
        throw PartnerLost(
            fmt::format("{0} was started without its partner: the scene couples "
                        "structure and fluid, and no {1} process is in this MPI job; "
                        "start both in one mpirun (mpirun -n 1 magfsi-structure SCENE : "
                        "-n 1 magfsi-fluid-lbm SCENE) or use ./magfsi run SCENE",
                        to_string(self_), to_string(other())));
    }
    if (first >= 0 && !expected) {
        throw PartnerLost(fmt::format(
            "a {1} process was started beside the {0}, but the {0}'s scene has no {1}: "
            "start only magfsi's {0}, or give both sides the same scene",
            to_string(self_), to_string(other())));
    }
    if (first < 0) return;
    MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, first, intercommunicator_tag,
                         &partner_);
    MPI_Comm_remote_size(partner_, &partner_size_);
}

void World::join_controller(int first, bool expected) {
    if ((first >= 0) != expected) {
        throw PartnerLost(
            expected
                ? "the structure was started without its controller: start python3 -m "
                  "magfsi.controller in the same mpirun, or use ./magfsi run SCENE"
                : "a controller was started beside the structure, whose scene has no "
                  "control: start only the structure and its partner");
    }
    if (first < 0) return;
    MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, first, controller_tag, &controller_);
}

World::~World() {
    set_awaited({});
    for (MPI_Comm* comm : {&partner_, &controller_, &local_})
        if (*comm != MPI_COMM_NULL) MPI_Comm_free(comm);
}

}  // namespace magfsi::coupler
