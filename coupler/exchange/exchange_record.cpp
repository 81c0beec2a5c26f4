// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/exchange/exchange_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

namespace {

constexpr std::size_t header_block = 4096;
constexpr const char* magic = "magfsi exchange record";

std::string header_text(const RecordHeader& header) {
    nlohmann::ordered_json json{{"format", magic},
                                {"version", 1},
                                {"offset", 0},
                                {"step_s", header.step_s},
                                {"first_step", header.first_step},
                                {"markers", header.markers},
                                {"numbers", header.numbers},
                                {"values", record_values_of(header.forcing)},
                                {"grid", nlohmann::json::parse(to_text(header.grid))}};
    const auto with_newline = json.dump().size() + 20;
    const auto blocks = (with_newline + header_block - 1) / header_block;
    json["offset"] = blocks * header_block;
    std::string text = json.dump();
    text.resize(blocks * header_block - 1, ' ');
    return text + '\n';
}

}  // namespace

RecordWriter::RecordWriter(const std::filesystem::path& path, const RecordHeader& header)
    : file_(path) {
    file_.write(header_text(header));
}

void RecordWriter::append(std::int64_t step, std::span<const double> numbers,
                          std::span<const double> rows) {
    entry_.assign(1, static_cast<double>(step));
    entry_.insert(entry_.end(), numbers.begin(), numbers.end());
    entry_.insert(entry_.end(), rows.begin(), rows.end());
    const auto bytes = std::as_bytes(std::span(entry_));
    file_.write_record({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

RecordReader::RecordReader(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary) {
    std::string line;
    if (!file_ || !std::getline(file_, line)) {
        throw std::invalid_argument(fmt::format(
            "{}: there is no record to play; make one with magfsi run --record",
            path_.string()));
    }
    try {
        const auto json = nlohmann::json::parse(line);
        if (json.at("format") != magic || json.at("version") != 1)
            throw std::runtime_error("another format");
        offset_ = json.at("offset");
        header_.step_s = json.at("step_s");
        header_.first_step = json.at("first_step");
        header_.markers = json.at("markers");
        header_.numbers = json.at("numbers");
        if (json.value("values", record_values_of(Forcing::penalty)) ==
            record_values_of(Forcing::no_slip))
            header_.forcing = Forcing::no_slip;
        header_.grid = grid_from_text(json.at("grid").dump());
    } catch (const std::exception& e) {
        throw std::invalid_argument(fmt::format("{}: not a record of an exchange ({})",
                                                path_.string(), e.what()));
    }
    const std::int64_t size = std::filesystem::file_size(path_);
    entries_ = (size - offset_) / static_cast<std::int64_t>(entry_bytes());
}

std::size_t RecordReader::entry_bytes() const {
    return sizeof(double) *
           (1 + header_.numbers + record_values_of(header_.forcing) * header_.markers);
}

RecordEntry RecordReader::read(std::int64_t entry) {
    if (entry < 0 || entry >= entries_) {
        throw std::runtime_error(
            fmt::format("{} ends after {} coupled steps; set time.end to that",
                        path_.string(), entries_ - 1));
    }
    std::vector<double> all(entry_bytes() / sizeof(double));
    file_.seekg(offset_ + entry * static_cast<std::int64_t>(entry_bytes()));
    if (!file_.read(reinterpret_cast<char*>(all.data()),
                    static_cast<std::streamsize>(entry_bytes()))) {
        throw std::runtime_error(fmt::format("cannot read {}", path_.string()));
    }
    RecordEntry result;
    result.step = all.front();
    const double* at = all.data() + 1 + header_.numbers;
    result.numbers.assign(all.begin() + 1,
                          all.begin() + 1 + static_cast<std::ptrdiff_t>(header_.numbers));
    for (std::size_t m = 0; m < header_.markers; ++m) {
        result.position_m.push_back(get(at));
        result.impulse.push_back(get(at + 3));
        result.velocity.push_back(get(at + 6));
        if (header_.forcing == Forcing::no_slip) {
            result.volume_m3.push_back(at[9]);
            result.answer.row_sum.push_back(at[10]);
            result.answer.passed.push_back(get(at + 11));
        }
        at += record_values_of(header_.forcing);
    }
    return result;
}

}  // namespace magfsi::coupler
