#include "coupler/scheme/acceleration.h"

#include "coupler/scheme/aitken.h"
#include "coupler/scheme/iqn_ils.h"
#include "coupler/scheme/under_relaxation.h"

namespace magfsi::coupler {

std::unique_ptr<Acceleration> make_acceleration(MPI_Comm comm,
                                                const scene::Iteration& wanted) {
    switch (wanted.acceleration) {
        case scene::Acceleration::under_relaxation:
            return std::make_unique<UnderRelaxation>(wanted.relaxation);
        case scene::Acceleration::aitken:
            return std::make_unique<Aitken>(comm, wanted.relaxation);
        case scene::Acceleration::iqn_ils:
            break;
    }
    return std::make_unique<IqnIls>(comm, wanted);
}

}  // namespace magfsi::coupler
