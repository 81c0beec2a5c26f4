#include "coupler/checkpoint/open_restart.h"

#include "coupler/checkpoint/checkpoint_files.h"

namespace magfsi::coupler {

StateReader open_restart(const Session& session) {
    return StateReader(checkpoint_file(session.restart()->folder,
                                       session.restart()->header.step,
                                       session.world().self()));
}

}  // namespace magfsi::coupler
