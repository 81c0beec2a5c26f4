// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/transfer.h"

#include "fluid_lbm/refinement/boxes.h"

namespace magfsi::fluid {

namespace {

constexpr int transfer_tag = 57;

// The row in the owner's indices.
CellRow less(CellRow row, const std::array<int, 3>& image) {
    row.x_begin -= image[0];
    row.x_end -= image[0];
    row.y -= image[1];
    row.z -= image[2];
    return row;
}

}  // namespace

CellTransfer::CellTransfer(MPI_Comm comm, const std::vector<std::vector<CellBox>>& owned,
                           const std::array<int, 3>& period,
                           const std::vector<std::vector<CellBox>>& wanted)
    : comm_(comm) {
    MPI_Comm_rank(comm_, &rank_);
    for (int other = 0; other < static_cast<int>(owned.size()); ++other) {
        const auto add = [&](std::vector<Part>& parts, std::vector<int>& ranks, int owner,
                             int wants) {
            const std::size_t before = parts.size();
            const std::size_t boxes = owned[owner].size();
            for (std::size_t i = 0; i < wanted[wants].size() * boxes; ++i) {
                const std::size_t b = i / boxes, from = i % boxes;
                for_each_image(period, [&](const std::array<int, 3>& image) {
                    const CellBox cells =
                        shared(wanted[wants][b], shifted(owned[owner][from], image));
                    if (!is_empty(cells)) parts.push_back({other, from, b, cells, image});
                });
            }
            if (parts.size() > before && other != rank_) ranks.push_back(other);
        };
        add(in_, from_, other, rank_);
        if (other != rank_) add(out_, to_, rank_, other);
    }
    sent_.resize(to_.size());
    received_.resize(from_.size());
}

std::size_t CellTransfer::cells_with(const std::vector<Part>& parts, int rank) {
    std::size_t cells = 0;
    for (const Part& part : parts)
        if (part.rank == rank) cells += static_cast<std::size_t>(cells_of(part.cells));
    return cells;
}

void CellTransfer::pass_to_itself(const Pass& pass) const {
    for (const Part& part : in_) {
        if (part.rank != rank_) continue;
        for_each_row(part.cells, [&](const CellRow& row) {
            pass(part.from, less(row, part.image), part.box, row);
        });
    }
}

void CellTransfer::run(std::size_t numbers, const Read& read, const Take& take,
                       const Pass& pass) {
    std::vector<MPI_Request> requests;
    for (std::size_t i = 0; i < from_.size(); ++i) {
        received_[i].resize(numbers * cells_with(in_, from_[i]));
        MPI_Irecv(received_[i].data(), received_[i].size(), MPI_DOUBLE, from_[i],
                  transfer_tag, comm_, &requests.emplace_back());
    }
    for (std::size_t i = 0; i < to_.size(); ++i) {
        sent_[i].resize(numbers * cells_with(out_, to_[i]));
        double* at = sent_[i].data();
        for (const Part& part : out_) {
            if (part.rank != to_[i]) continue;
            for_each_row(part.cells, [&](const CellRow& row) {
                read(part.from, less(row, part.image), at);
                at += numbers * row.size();
            });
        }
        MPI_Isend(sent_[i].data(), sent_[i].size(), MPI_DOUBLE, to_[i], transfer_tag,
                  comm_, &requests.emplace_back());
    }
    if (pass) {
        pass_to_itself(pass);
    } else {
        pass_to_itself([&](std::size_t from, const CellRow& owned, std::size_t box,
                           const CellRow& row) {
            row_.resize(numbers * row.size());
            read(from, owned, row_.data());
            take(box, row, row_.data());
        });
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    for (std::size_t i = 0; i < from_.size(); ++i) {
        const double* at = received_[i].data();
        for (const Part& part : in_) {
            if (part.rank != from_[i]) continue;
            for_each_row(part.cells, [&](const CellRow& row) {
                take(part.box, row, at);
                at += numbers * row.size();
            });
        }
    }
}

std::vector<std::vector<CellBox>> one_each(const std::vector<CellBox>& boxes) {
    std::vector<std::vector<CellBox>> all;
    for (const CellBox& box : boxes) all.push_back({box});
    return all;
}

}  // namespace magfsi::fluid
