// One participant's file of a checkpoint: tables of numbers in HDF5. It takes its name
// only when it is complete and on the disk, so a kill in the middle leaves the
// checkpoints before it as they were.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "coupler/checkpoint/state_header.h"

namespace magfsi::coupler {

enum class StoredAs { double_, float_ };  // float: for values that are exact in it

class StateWriter {
  public:
    // Throws output::FileError, also from the calls below, on a failing disk.
    StateWriter(std::filesystem::path path, const StateHeader& header);
    ~StateWriter();  // takes the temporary file away unless committed
    StateWriter(const StateWriter&) = delete;
    StateWriter& operator=(const StateWriter&) = delete;

    // A whole table. An empty one is left out.
    void table(const std::string& name, std::span<const double> values,
               std::vector<std::size_t> shape);

    // A large one, plane by plane along its first dimension, in any order.
    void begin_table(const std::string& name, std::vector<std::size_t> shape,
                     StoredAs stored_as);
    void plane(std::size_t index, std::span<const double> values);

    void commit();

  private:
    struct Files;
    template <class Work>
    void guarded(Work&& work);

    std::filesystem::path path_;
    std::unique_ptr<Files> files_;
    bool committed_ = false;
};

}  // namespace magfsi::coupler
