// An HDF5 object that is closed with its owner, and HDF5's errors as one line.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace magfsi::coupler {

// "cannot read dataset fluid: Can't open object"; the caller names the file.
class Hdf5Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Keeps HDF5 from printing its stack of errors and from locking files; call before
// anything else of it.
void prepare_hdf5();

// Returns what HDF5 returned, or throws with HDF5's innermost reason.
hid_t checked(hid_t returned, const std::string& what);

class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle() = default;
    Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    ~Hdf5Handle() { reset(); }
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
        reset();
        id_ = std::exchange(other.id_, -1);
        close_ = other.close_;
        return *this;
    }

    hid_t get() const { return id_; }
    // Closes now; negative if that failed.
    herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

}  // namespace magfsi::coupler
