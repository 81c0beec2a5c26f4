#include "coupler/participants/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

constexpr int intercommunicator_tag = 71;

// The world rank of the first process of each role, or -1.
int first_rank(const std::vector<int>& roles, Role role) {
    const auto at = std::find(roles.begin(), roles.end(), static_cast<int>(role));
    return at == roles.end() ? -1 : static_cast<int>(at - roles.begin());
}

}  // namespace

std::string to_string(Role role) {
    return role == Role::structure ? "structure" : "fluid";
}

World::World(Role self, bool partner_expected) : self_(self) {
    int world_rank = 0;
    int world_size = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &world_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &world_size);
    MPI_Comm_split(MPI_COMM_WORLD, static_cast<int>(self), world_rank, &local_);
    MPI_Comm_rank(local_, &rank_);
    MPI_Comm_size(local_, &size_);

    const int mine = static_cast<int>(self);
    std::vector<int> roles(static_cast<std::size_t>(world_size));
    MPI_Allgather(&mine, 1, MPI_INT, roles.data(), 1, MPI_INT, MPI_COMM_WORLD);
    const int partner = first_rank(roles, other());
    if (partner < 0 && partner_expected) {
        throw PartnerLost(fmt::format(
            "{0} was started without its partner: the scene couples structure and fluid, "
            "and "
            "no {1} process is in this MPI job; start both in one mpirun (mpirun -n 1 "
            "magfsi-structure SCENE : -n 1 magfsi-fluid-lbm SCENE) or use ./magfsi run "
            "SCENE",
            to_string(self_), to_string(other())));
    }
    if (partner >= 0 && !partner_expected) {
        throw PartnerLost(
            fmt::format("a {1} process was started beside the {0}, but the {0}'s scene "
                        "has no {1}: start "
                        "only magfsi's {0}, or give both sides the same scene",
                        to_string(self_), to_string(other())));
    }
    if (partner >= 0) {
        MPI_Intercomm_create(local_, 0, MPI_COMM_WORLD, partner, intercommunicator_tag,
                             &partner_);
        MPI_Comm_remote_size(partner_, &partner_size_);
    }
}

World::~World() {
    if (partner_ != MPI_COMM_NULL) MPI_Comm_free(&partner_);
    if (local_ != MPI_COMM_NULL) MPI_Comm_free(&local_);
}

}  // namespace magfsi::coupler
