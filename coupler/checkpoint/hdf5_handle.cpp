#include "coupler/checkpoint/hdf5_handle.h"

#include <cstdlib>

namespace magfsi::coupler {

namespace {

// The innermost entry comes first upwards: the cause, not its consequences.
herr_t take_first(unsigned depth, const H5E_error2_t* entry, void* text) {
    if (depth == 0 && entry->desc != nullptr)
        *static_cast<std::string*>(text) = entry->desc;
    return 0;
}

}  // namespace

void prepare_hdf5() {
    // Some network file systems have no locks and would refuse every file; ours are
    // never written once they have their name.
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
    // At the process's end HDF5 would flush what a full disk has refused once, and crash.
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

hid_t checked(hid_t returned, const std::string& what) {
    if (returned >= 0) return returned;
    std::string reason = "unknown reason";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &take_first, &reason);
    throw Hdf5Error(what + ": " + reason);
}

}  // namespace magfsi::coupler
