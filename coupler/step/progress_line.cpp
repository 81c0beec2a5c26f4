#include "coupler/step/progress_line.h"

#include <fmt/format.h>

#include <cstdio>

namespace magfsi::coupler {

std::unique_ptr<output::Progress> progress_on_stdout(const Session& session,
                                                     output::ProgressMode mode) {
    const char* const end = mode == output::ProgressMode::plain ? "\n" : "";
    return std::make_unique<output::Progress>(
        mode,
        output::ProgressGoal{session.clock().steps(), session.plan().end_s,
                             session.clock().first_step()},
        [end](std::string_view text) {
            fmt::print("{}{}", text, end);
            std::fflush(stdout);
        });
}

}  // namespace magfsi::coupler
