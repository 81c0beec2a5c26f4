#include "coupler/step/log_head.h"

#include <sstream>

#include "coupler/participants/handshake.h"

namespace magfsi::coupler {

void log_effects(const Session& session) {
    for (const std::string& line : session.plan().effects_by_step)
        session.log("effects of the " + line);
    for (const std::string& line : session.plan().warnings)
        session.log("warning: " + line);
}

void log_steps(const Session& session, const TaskList& tasks, const std::string& about) {
    std::string text = to_string(session.world().self()) + " step: " + tasks.names();
    if (!about.empty()) text.insert(0, about + "\n");
    if (session.world().coupled()) {
        const std::string other =
            swap_text(session.world(), text, session.timeout_s(), "list of its tasks");
        text += "\n" + other;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) session.log(line);
}

}  // namespace magfsi::coupler
