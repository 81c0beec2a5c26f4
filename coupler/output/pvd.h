// ParaView's collection: which file holds which instant. Valid after every call.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace magfsi::output {

class PvdSeries {
  public:
    // Writes an empty collection, so that a folder that cannot be written to is found out
    // at the start of a run. Throws FileError.
    explicit PvdSeries(std::filesystem::path path);

    // `file` as this process would open it (the collection names it relative to itself);
    // times must rise. Add a file only once it is complete. Throws std::invalid_argument,
    // FileError.
    void add(double time_s, const std::filesystem::path& file);

  private:
    void write() const;

    struct Entry {
        double time_s;
        std::string file;
    };
    std::filesystem::path path_;
    std::vector<Entry> entries_;
};

}  // namespace magfsi::output
