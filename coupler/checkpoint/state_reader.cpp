#include "coupler/checkpoint/state_reader.h"

#include <fmt/format.h>

#include <functional>
#include <numeric>

#include "coupler/checkpoint/hdf5_handle.h"

namespace magfsi::coupler {

struct StateReader::Files {
    Hdf5Handle file;
};

namespace {

using Sizes = std::vector<hsize_t>;

// Numbers; a larger table is one of planes (StateWriter::begin_table).
constexpr std::size_t largest_at_once = std::size_t{1} << 24;

std::size_t product(const Sizes& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1},
                           std::multiplies<>());
}

void attribute(hid_t file, const char* name, hid_t type, void* value) {
    const Hdf5Handle a(checked(H5Aopen(file, name, H5P_DEFAULT), name), &H5Aclose);
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
    const Hdf5Handle memory(
        checked(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                "block"),
        &H5Sclose);
    const Hdf5Handle place(checked(H5Dget_space(table), "block"), &H5Sclose);
    checked(H5Sselect_hyperslab(place.get(), H5S_SELECT_SET, start.data(), nullptr,
                                count.data(), nullptr),
            "block");
    checked(
        H5Dread(table, H5T_NATIVE_DOUBLE, memory.get(), place.get(), H5P_DEFAULT, out),
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
    guarded([&] {
        files_->file = Hdf5Handle(
            checked(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open"),
            &H5Fclose);
        const hid_t file = files_->file.get();
        std::int64_t format = 0;
        attribute(file, "format", H5T_NATIVE_INT64, &format);
        if (format != state_format) throw Hdf5Error(fmt::format("format {}", format));
        attribute(file, "state_hash", H5T_NATIVE_UINT64, &header_.state_hash);
        attribute(file, "step", H5T_NATIVE_INT64, &header_.step);
        attribute(file, "step_s", H5T_NATIVE_DOUBLE, &header_.step_s);
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
            const bool large = product(count) > largest_at_once;
            const hsize_t planes = large ? std::exchange(count[0], 1) : 1;
            values.resize(product(count));
            for (; start[0] < planes; ++start[0])
                read_block(data.get(), start, count, values.data());
        }
    });
}

}  // namespace magfsi::coupler
