#include "coupler/step/log_head.h"

#include "coupler/scene/effective.h"

namespace magfsi::coupler {

void log_effects(const Session& session) {
    for (const std::string& line : scene::effects_by_step(session.scene()))
        session.log("effects of the " + line);
    for (const std::string& line : scene::idle_effects(session.scene()))
        session.log("warning: " + line);
}

}  // namespace magfsi::coupler
