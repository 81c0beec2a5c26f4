#include "adapters/magfsi/mpirun_messages.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace magfsi::launch {

namespace {

// Open MPI frames its banners with lines of dashes.
bool is_rule(const std::string& line) {
    return line.size() > 40 && line.find_first_not_of('-') == std::string::npos;
}

// Banners that say in other words what magfsi says itself.
bool is_known(const std::vector<std::string>& block) {
    constexpr const char* known[] = {
        "MPI_ABORT was invoked", "Primary job  terminated normally",
        "mpirun noticed that process", "mpirun detected that one",
        "mpirun has exited due to process rank"};
    return std::ranges::any_of(block, [&](const std::string& line) {
        return std::ranges::any_of(known, [&](const char* text) {
            return line.find(text) != std::string::npos;
        });
    });
}

// Open MPI's own lines "[host:pid] ..." about the banners above, and about a read of
// shared memory that a killed partner had offered.
bool is_echo(const std::string& line) {
    constexpr const char* known[] = {"more process has sent help message",
                                     "more processes have sent help message",
                                     "Set MCA parameter \"orte_base_help_aggregate\"",
                                     "ORTE_ERROR_LOG", "Read -1, expected"};
    return line.starts_with('[') && std::ranges::any_of(known, [&](const char* text) {
               return line.find(text) != std::string::npos;
           });
}

}  // namespace

std::vector<std::string> MpirunMessages::take(const std::string& line) {
    int rank = 0;
    const char* at = std::strstr(line.c_str(), "process rank ");
    const char* signal = std::strstr(line.c_str(), "exited on signal ");
    int number = 0;
    if (at && signal && std::sscanf(at, "process rank %d", &rank) == 1 &&
        std::sscanf(signal, "exited on signal %d", &number) == 1) {
        lost_ = LostProcess{rank, number};
    }
    if (is_rule(line)) {
        if (in_block_) return close_block();
        in_block_ = true;
        return {};
    }
    if (is_echo(line)) return {};
    if (!in_block_) return {line};
    block_.push_back(line);
    return {};
}

std::vector<std::string> MpirunMessages::close_block() {
    in_block_ = false;
    std::vector<std::string> shown;
    if (!is_known(block_)) shown = block_;
    block_.clear();
    return shown;
}

std::vector<std::string> MpirunMessages::rest() {
    return close_block();
}

}  // namespace magfsi::launch
