// mpirun's error output, line by line: its banners are kept from the user, and what they
// tell about a killed process is kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace magfsi::launch {

struct LostProcess {
    int world_rank = -1;
    int signal = 0;
};

class MpirunMessages {
  public:
    // The lines to show in place of this one.
    std::vector<std::string> take(const std::string& line);
    // What is left at the end of the stream.
    std::vector<std::string> rest();

    const std::optional<LostProcess>& lost() const { return lost_; }

  private:
    std::vector<std::string> close_block();

    bool in_block_ = false;
    std::vector<std::string> block_;
    std::optional<LostProcess> lost_;
};

}  // namespace magfsi::launch
