// Reads what StateWriter wrote.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/checkpoint/state_header.h"

namespace magfsi::coupler {

// A file that is missing, cut short, damaged, or no checkpoint; names it and the reason.
class StateFault : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

class StateReader {
  public:
    // Throws StateFault, as all calls below do.
    explicit StateReader(std::filesystem::path path);
    ~StateReader();
    StateReader(const StateReader&) = delete;
    StateReader& operator=(const StateReader&) = delete;

    const StateHeader& header() const { return header_; }
    bool has(const std::string& table) const;
    std::vector<std::size_t> shape(const std::string& table) const;
    std::vector<double> table(const std::string& table) const;

    // Rows begin to end of the second dimension of one plane of the first; out holds them
    // with all further dimensions.
    void rows(const std::string& table, std::size_t plane, std::size_t begin,
              std::size_t end, std::span<double> out) const;

    // Reads all there is, plane by plane: throws if a checksum does not fit.
    void verify() const;

  private:
    struct Files;
    template <class Work>
    auto guarded(Work&& work) const;

    std::filesystem::path path_;
    StateHeader header_;
    std::unique_ptr<Files> files_;
};

}  // namespace magfsi::coupler
