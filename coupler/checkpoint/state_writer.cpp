#include "coupler/checkpoint/state_writer.h"

#include <unistd.h>

#include <cerrno>

#include "coupler/checkpoint/hdf5_handle.h"
#include "coupler/output/atomic_file.h"

namespace magfsi::coupler {

struct StateWriter::Files {
    Hdf5Handle file;
    Hdf5Handle table;  // the one that planes go to
    std::vector<hsize_t> shape;
};

namespace {

void attribute(hid_t file, const char* name, hid_t type, const void* value) {
    const Hdf5Handle space(checked(H5Screate(H5S_SCALAR), name), &H5Sclose);
    const Hdf5Handle a(
        checked(H5Acreate2(file, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                name),
        &H5Aclose);
    checked(H5Awrite(a.get(), type, value), name);
}

Hdf5Handle create_file(const std::string& path) {
    const Hdf5Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), path), &H5Pclose);
    // The newest format has checksums of its own structure.
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const Hdf5Handle creation(checked(H5Pcreate(H5P_FILE_CREATE), path), &H5Pclose);
    // No time of day, here and below: equal states give equal files.
    checked(H5Pset_obj_track_times(creation.get(), false), path);
    return {checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                    path),
            &H5Fclose};
}

// One chunk a plane with a checksum: damage is found when it is read.
Hdf5Handle create_table(hid_t file, const std::string& name,
                        const std::vector<hsize_t>& shape,
                        const std::vector<hsize_t>& chunk, hid_t type) {
    const auto rank = static_cast<int>(shape.size());
    const Hdf5Handle space(checked(H5Screate_simple(rank, shape.data(), nullptr), name),
                           &H5Sclose);
    const Hdf5Handle how(checked(H5Pcreate(H5P_DATASET_CREATE), name), &H5Pclose);
    checked(H5Pset_chunk(how.get(), rank, chunk.data()), name);
    checked(H5Pset_fletcher32(how.get()), name);
    checked(H5Pset_obj_track_times(how.get(), false), name);
    return {checked(H5Dcreate2(file, name.c_str(), type, space.get(), H5P_DEFAULT,
                               how.get(), H5P_DEFAULT),
                    name),
            &H5Dclose};
}

}  // namespace

// HDF5 tells only its own view; the system's number, where there is one, tells the cause.
template <class Work>
void StateWriter::guarded(Work&& work) {
    errno = 0;
    try {
        work();
    } catch (const Hdf5Error&) {
        throw output::FileError(path_, errno != 0 ? errno : EIO);
    }
}

StateWriter::StateWriter(std::filesystem::path path, const StateHeader& header)
    : path_(std::move(path)), files_(std::make_unique<Files>()) {
    prepare_hdf5();
    guarded([&] {
        files_->file = create_file(output::temporary_of(path_).string());
        const hid_t file = files_->file.get();
        attribute(file, "format", H5T_NATIVE_INT64, &state_format);
        attribute(file, "state_hash", H5T_NATIVE_UINT64, &header.state_hash);
        attribute(file, "step", H5T_NATIVE_INT64, &header.step);
        attribute(file, "step_s", H5T_NATIVE_DOUBLE, &header.step_s);
    });
}

StateWriter::~StateWriter() {
    if (committed_) return;
    files_.reset();
    ::unlink(output::temporary_of(path_).c_str());
}

void StateWriter::table(const std::string& name, std::span<const double> values,
                        std::vector<std::size_t> shape) {
    if (values.empty()) return;
    const std::vector<hsize_t> sizes(shape.begin(), shape.end());
    guarded([&] {
        const Hdf5Handle data =
            create_table(files_->file.get(), name, sizes, sizes, H5T_IEEE_F64LE);
        checked(H5Dwrite(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         values.data()),
                name);
    });
}

void StateWriter::begin_table(const std::string& name, std::vector<std::size_t> shape,
                              StoredAs stored_as) {
    files_->shape.assign(shape.begin(), shape.end());
    std::vector<hsize_t> chunk = files_->shape;
    chunk[0] = 1;
    guarded([&] {
        files_->table =
            create_table(files_->file.get(), name, files_->shape, chunk,
                         stored_as == StoredAs::float_ ? H5T_IEEE_F32LE : H5T_IEEE_F64LE);
    });
}

void StateWriter::plane(std::size_t index, std::span<const double> values) {
    std::vector<hsize_t> start(files_->shape.size(), 0), count = files_->shape;
    start[0] = index;
    count[0] = 1;
    const auto rank = static_cast<int>(count.size());
    guarded([&] {
        const Hdf5Handle memory(
            checked(H5Screate_simple(rank, count.data(), nullptr), "plane"), &H5Sclose);
        const Hdf5Handle place(checked(H5Dget_space(files_->table.get()), "plane"),
                               &H5Sclose);
        checked(H5Sselect_hyperslab(place.get(), H5S_SELECT_SET, start.data(), nullptr,
                                    count.data(), nullptr),
                "plane");
        checked(H5Dwrite(files_->table.get(), H5T_NATIVE_DOUBLE, memory.get(),
                         place.get(), H5P_DEFAULT, values.data()),
                "plane");
    });
}

void StateWriter::commit() {
    guarded([&] {
        checked(files_->table.reset(), "close");
        checked(files_->file.reset(), "close");
    });
    output::publish(path_, output::Survives::power_cut);
    committed_ = true;
}

}  // namespace magfsi::coupler
