// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/checkpoint/state_file.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "coupler/output/file.h"

namespace magfsi::coupler {

namespace {

constexpr std::int64_t state_format = 2;

// An error of HDF5: "cannot read dataset fluid: Can't open object", without the file.
class Hdf5Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Owns an HDF5 object and closes it.
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
    // Closes the object and returns HDF5's status, which is negative on failure.
    herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

// The first entry of an upward walk through the error stack is the cause.
herr_t take_first(unsigned depth, const H5E_error2_t* entry, void* text) {
    if (depth == 0 && entry->desc != nullptr)
        *static_cast<std::string*>(text) = entry->desc;
    return 0;
}

// Keeps HDF5 from printing its error stack and from locking files. To be called before
// anything else of HDF5.
void prepare_hdf5() {
    // Some network file systems have no locks and would refuse every file. Files of a
    // checkpoint need none: they are not written to once they have their name.
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
    // At the process's end HDF5 would flush again what a full disk refused, and crash.
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// Returns what HDF5 returned, or throws Hdf5Error with HDF5's innermost reason.
hid_t checked(hid_t returned, const std::string& what) {
    if (returned >= 0) return returned;
    std::string reason = "unknown reason";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &take_first, &reason);
    throw Hdf5Error(what + ": " + reason);
}

using Sizes = std::vector<hsize_t>;

// The dataspaces of a block: that in memory and that in the table.
struct Block {
    Hdf5Handle memory, place;
};

Block block_of(hid_t table, const Sizes& start, const Sizes& count) {
    Block block{
        {checked(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                 "block"),
         &H5Sclose},
        {checked(H5Dget_space(table), "block"), &H5Sclose}};
    checked(H5Sselect_hyperslab(block.place.get(), H5S_SELECT_SET, start.data(), nullptr,
                                count.data(), nullptr),
            "block");
    return block;
}

}  // namespace

struct StateWriter::Files {
    Hdf5Handle file;
    Hdf5Handle table;  // the table that plane() writes to
    Sizes shape;
    std::uint64_t sum = 0;  // checksum of the planes written so far
};

namespace {

constexpr const char* sum_name = "sum";

// Checksum of consecutive planes; `first` is the number of the first one in the table.
// That of a table is the sum over its planes, in any order. Each value passes through a
// bijective mix, so that a change of one number always shows. Unlike with HDF5's
// Fletcher32 zeros have a sum: an end that a power cut left unwritten reads as zeros.
std::uint64_t sum_of_planes(std::span<const double> values, std::size_t first,
                            std::size_t planes) {
    const std::size_t size = values.size() / planes;
    std::uint64_t sum = 0;
    for (std::size_t p = 0; p < planes; ++p) {
        std::uint64_t mixed = first + p + 1;
        for (const double value : values.subspan(p * size, size)) {
            mixed = (mixed ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15U;
            mixed ^= mixed >> 32U;
        }
        sum += mixed;
    }
    return sum;
}

void write_attribute(hid_t owner, const char* name, hid_t type, const void* value) {
    const Hdf5Handle space(checked(H5Screate(H5S_SCALAR), name), &H5Sclose);
    const Hdf5Handle a(
        checked(H5Acreate2(owner, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                name),
        &H5Aclose);
    checked(H5Awrite(a.get(), type, value), name);
}

Hdf5Handle create_file(const std::string& path) {
    const Hdf5Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), path), &H5Pclose);
    // The newest format protects its own metadata with checksums.
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const Hdf5Handle creation(checked(H5Pcreate(H5P_FILE_CREATE), path), &H5Pclose);
    // Times are left out here and below, so that equal states give equal files.
    checked(H5Pset_obj_track_times(creation.get(), false), path);
    return {checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                    path),
            &H5Fclose};
}

Hdf5Handle create_table(hid_t file, const std::string& name, const Sizes& shape,
                        const Sizes& chunk, hid_t type) {
    const int rank = shape.size();
    const Hdf5Handle space(checked(H5Screate_simple(rank, shape.data(), nullptr), name),
                           &H5Sclose);
    const Hdf5Handle how(checked(H5Pcreate(H5P_DATASET_CREATE), name), &H5Pclose);
    checked(H5Pset_chunk(how.get(), rank, chunk.data()), name);
    checked(H5Pset_obj_track_times(how.get(), false), name);
    return {checked(H5Dcreate2(file, name.c_str(), type, space.get(), H5P_DEFAULT,
                               how.get(), H5P_DEFAULT),
                    name),
            &H5Dclose};
}

}  // namespace

// Turns HDF5's error into a FileError with the system's errno, which names the cause.
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
        write_attribute(file, "format", H5T_NATIVE_INT64, &state_format);
        write_attribute(file, "state_hash", H5T_NATIVE_UINT64, &header.state_hash);
        write_attribute(file, "step", H5T_NATIVE_INT64, &header.step);
        write_attribute(file, "step_s", H5T_NATIVE_DOUBLE, &header.step_s);
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
    const Sizes sizes(shape.begin(), shape.end());
    guarded([&] {
        const Hdf5Handle data =
            create_table(files_->file.get(), name, sizes, sizes, H5T_IEEE_F64LE);
        checked(H5Dwrite(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         values.data()),
                name);
        const std::uint64_t sum = sum_of_planes(values, 0, shape[0]);
        write_attribute(data.get(), sum_name, H5T_NATIVE_UINT64, &sum);
    });
}

void StateWriter::end_table() {
    if (files_->table.get() < 0) return;
    write_attribute(files_->table.get(), sum_name, H5T_NATIVE_UINT64, &files_->sum);
    files_->sum = 0;
    checked(files_->table.reset(), "close");
}

void StateWriter::begin_table(const std::string& name, std::vector<std::size_t> shape,
                              StoredAs stored_as) {
    files_->shape.assign(shape.begin(), shape.end());
    Sizes chunk = files_->shape;
    chunk[0] = 1;
    guarded([&] {
        end_table();
        files_->table =
            create_table(files_->file.get(), name, files_->shape, chunk,
                         stored_as == StoredAs::float_ ? H5T_IEEE_F32LE : H5T_IEEE_F64LE);
    });
}

void StateWriter::plane(std::size_t index, std::span<const double> values) {
    Sizes start(files_->shape.size(), 0), count = files_->shape;
    start[0] = index;
    count[0] = 1;
    guarded([&] {
        const hid_t table = files_->table.get();
        const Block block = block_of(table, start, count);
        checked(H5Dwrite(table, H5T_NATIVE_DOUBLE, block.memory.get(), block.place.get(),
                         H5P_DEFAULT, values.data()),
                "plane");
    });
    files_->sum += sum_of_planes(values, index, 1);
}

void StateWriter::commit() {
    guarded([&] {
        end_table();
        checked(files_->file.reset(), "close");
    });
    output::publish(path_, output::Survives::power_cut);
    committed_ = true;
}

struct StateReader::Files {
    Hdf5Handle file;
};

namespace {

// Largest number of values read at once; larger tables were written in planes.
constexpr std::size_t largest_at_once = std::size_t{1} << 24;

std::size_t product(const Sizes& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1},
                           std::multiplies<>());
}

void read_attribute(hid_t owner, const char* name, hid_t type, void* value) {
    const Hdf5Handle a(checked(H5Aopen(owner, name, H5P_DEFAULT), name), &H5Aclose);
    checked(H5Aread(a.get(), type, value), name);
}

Hdf5Handle open_table(hid_t file, const std::string& name) {
    return {checked(H5Dopen2(file, name.c_str(), H5P_DEFAULT), name), &H5Dclose};
}

Sizes sizes_of(hid_t table) {
    const Hdf5Handle space(checked(H5Dget_space(table), "shape"), &H5Sclose);
    Sizes sizes(static_cast<std::size_t>(
        checked(H5Sget_simple_extent_ndims(space.get()), "shape")));
    checked(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr), "shape");
    return sizes;
}

void read_block(hid_t table, const Sizes& start, const Sizes& count, double* out) {
    const Block block = block_of(table, start, count);
    checked(H5Dread(table, H5T_NATIVE_DOUBLE, block.memory.get(), block.place.get(),
                    H5P_DEFAULT, out),
            "block");
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
}

}  // namespace

template <class Work>
auto StateReader::guarded(Work&& work) const {
    try {
        return work();
    } catch (const Hdf5Error& e) {
        throw StateFault(
            fmt::format("{} is torn or no checkpoint ({})", path_.string(), e.what()));
    }
}

StateReader::StateReader(std::filesystem::path path)
    : path_(std::move(path)), files_(std::make_unique<Files>()) {
    prepare_hdf5();
    if (!std::filesystem::exists(path_))
        throw StateFault(fmt::format("{} is missing", path_.string()));
    if (!std::filesystem::is_regular_file(path_))
        throw StateFault(fmt::format("{} is no regular file", path_.string()));
    guarded([&] {
        files_->file = Hdf5Handle(
            checked(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open"),
            &H5Fclose);
        const hid_t file = files_->file.get();
        std::int64_t format = 0;
        read_attribute(file, "format", H5T_NATIVE_INT64, &format);
        if (format != state_format) throw Hdf5Error(fmt::format("format {}", format));
        read_attribute(file, "state_hash", H5T_NATIVE_UINT64, &header_.state_hash);
        read_attribute(file, "step", H5T_NATIVE_INT64, &header_.step);
        read_attribute(file, "step_s", H5T_NATIVE_DOUBLE, &header_.step_s);
    });
}

StateReader::~StateReader() = default;

bool StateReader::has(const std::string& table) const {
    return H5Lexists(files_->file.get(), table.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::size_t> StateReader::shape(const std::string& table) const {
    return guarded([&] {
        const Sizes sizes = sizes_of(open_table(files_->file.get(), table).get());
        return std::vector<std::size_t>(sizes.begin(), sizes.end());
    });
}

std::vector<double> StateReader::table(const std::string& table) const {
    return guarded([&] {
        const Hdf5Handle data = open_table(files_->file.get(), table);
        const Sizes sizes = sizes_of(data.get());
        std::vector<double> values(product(sizes));
        read_block(data.get(), Sizes(sizes.size(), 0), sizes, values.data());
        return values;
    });
}

void StateReader::rows(const std::string& table, std::size_t plane, std::size_t begin,
                       std::size_t end, std::span<double> out) const {
    guarded([&] {
        const Hdf5Handle data = open_table(files_->file.get(), table);
        Sizes count = sizes_of(data.get());
        Sizes start(count.size(), 0);
        start[0] = plane;
        start[1] = begin;
        count[0] = 1;
        count[1] = end - begin;
        if (product(count) != out.size()) throw Hdf5Error(table + " has another shape");
        read_block(data.get(), start, count, out.data());
    });
}

void StateReader::verify() const {
    guarded([&] {
        std::vector<std::string> names;
        checked(H5Literate(files_->file.get(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr,
                           &collect_name, &names),
                "list of tables");
        std::vector<double> values;
        for (const std::string& name : names) {
            const Hdf5Handle data = open_table(files_->file.get(), name);
            Sizes count = sizes_of(data.get());
            Sizes start(count.size(), 0);
            if (count.empty() || product(count) == 0)
                throw Hdf5Error(name + ": no table");
            const bool large = product(count) > largest_at_once;
            const hsize_t planes = large ? std::exchange(count[0], 1) : 1;
            values.resize(product(count));
            std::uint64_t sum = 0, expected = 0;
            for (; start[0] < planes; ++start[0]) {
                read_block(data.get(), start, count, values.data());
                sum += sum_of_planes(values, start[0], count[0]);
            }
            read_attribute(data.get(), sum_name, H5T_NATIVE_UINT64, &expected);
            if (sum != expected) throw Hdf5Error(name + ": damaged numbers");
        }
    });
}

}  // namespace magfsi::coupler
