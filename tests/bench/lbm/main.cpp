// SPDX-License-Identifier: GPL-2.0-or-later
// Speed of the fluid's step for every collision, precision and share of forced rows,
// beside the in-place copy bandwidth of the same moment.
//
//   mpirun -n 2 magfsi-bench-lbm --cells 160 80 160
//   OMP_NUM_THREADS=2 magfsi-bench-lbm --collision trt --json
#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/isa/instruction_set.h"
#include "base/process/keep_libraries.h"
#include "tests/bench/lbm/measure.h"

namespace magfsi::bench {
namespace {

using fluid::Collision;
using fluid::Precision;

struct Options {
    Settings settings{{128, 128, 128}, 0.3, 7};
    std::vector<Collision> collisions{Collision::bgk, Collision::trt,
                                      Collision::recursive_regularized};
    std::vector<Precision> precisions{Precision::double_, Precision::float_};
    std::vector<double> forced{0, 1.0 / 9, 1};
    bool json = false;
    std::string peer;
};

template <class E>
std::map<std::string, E> by_name(std::initializer_list<E> values) {
    std::map<std::string, E> names;
    for (const E value : values) names.emplace(name_of(value), value);
    return names;
}

void declare(CLI::App& app, Options& o) {
    app.add_option("--cells", o.settings.cells, "nx ny nz")->check(CLI::Range(2, 10000));
    app.add_option("--seconds", o.settings.seconds, "of each measurement");
    app.add_option("--repetitions", o.settings.repetitions)->check(CLI::PositiveNumber);
    app.add_option("--collision", o.collisions)
        ->transform(CLI::CheckedTransformer(
            by_name({Collision::bgk, Collision::trt, Collision::recursive_regularized})));
    app.add_option("--precision", o.precisions)
        ->transform(
            CLI::CheckedTransformer(by_name({Precision::double_, Precision::float_})));
    app.add_option("--forced", o.forced, "share of the rows that carry a force")
        ->check(CLI::Range(0.0, 1.0));
    app.add_flag("--json", o.json);
    app.add_option("--peer", o.peer, "palabos: its speed beside ours")
        ->check(CLI::IsMember({"palabos"}));
}

nlohmann::json to_json(const Spread& s) {
    return {{"median", s.median}, {"low", s.low}, {"high", s.high}};
}

nlohmann::json to_json(const Result& r) {
    return {{"collision", name_of(r.variant.collision)},
            {"precision", name_of(r.variant.precision)},
            {"forced_share", r.variant.forced_share},
            {"mlups", to_json(r.mlups)},
            {"copy_gb_s", to_json(r.copy_gb_s)},
            {"share_of_limit", to_json(r.share_of_limit)},
            {"exchange_share", to_json(r.exchange_share)}};
}

void print(const Result& r) {
    fmt::print(
        "{:22} {:13} {:6.3f} {:8.1f} [{:6.1f} {:6.1f}] {:9.1f} {:8.3f} [{:.3f} "
        "{:.3f}] {:8.3f}\n",
        name_of(r.variant.collision), name_of(r.variant.precision),
        r.variant.forced_share, r.mlups.median, r.mlups.low, r.mlups.high,
        r.copy_gb_s.median, r.share_of_limit.median, r.share_of_limit.low,
        r.share_of_limit.high, r.exchange_share.median);
    std::fflush(stdout);
}

// The peer's collisions beside ours, run in turn. Waiting ranks sleep.
void compare_with_peer(const Options& o, int rank, int ranks, nlohmann::json& report) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() /
                         ("magfsi-bench-" + o.peer);
    const std::tuple<const char*, Collision, double> kinds[] = {
        {"bgk", Collision::bgk, 0},
        {"trt", Collision::trt, 0},
        {"guo", Collision::bgk, 1}};
    for (const auto& [kind, collision, forced] : kinds) {
        std::vector<double> ours, theirs, ratios;
        for (int i = 0; i < o.settings.repetitions; ++i) {
            Settings once = o.settings;
            once.repetitions = 1;
            const Variant variant{collision, Precision::double_, forced};
            ours.push_back(measure(MPI_COMM_WORLD, once, variant).mlups.median);
            theirs.push_back(0);
            if (rank == 0) {
                theirs.back() = peer_mlups(program.string(), o.settings, kind, ranks);
            }
            MPI_Bcast(&theirs.back(), 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
            ratios.push_back(ours.back() / theirs.back());
        }
        const Spread a = spread(ours), b = spread(theirs), r = spread(ratios);
        report["peer"].push_back({{"name", o.peer},
                                  {"kind", kind},
                                  {"ours_mlups", to_json(a)},
                                  {"theirs_mlups", to_json(b)},
                                  {"ratio", to_json(r)}});
        if (rank != 0 || o.json) continue;
        fmt::print("{} {}: {:.1f} MLUPS, ours {:.1f}, {:.1f} times [{:.1f} {:.1f}]\n",
                   o.peer, kind, b.median, a.median, r.median, r.low, r.high);
        std::fflush(stdout);
    }
}

void run(const Options& o) {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const bool talk = rank == 0 && !o.json;
    const auto& n = o.settings.cells;
    const std::string kernel = name(choose_instruction_set());
    nlohmann::json report{{"cells", n},
                          {"ranks", ranks},
                          {"threads", omp_get_max_threads()},
                          {"kernel", kernel}};
    if (talk) {
        fmt::print("{} x {} x {}, {} ranks, {} threads each, {}\n", n[0], n[1], n[2],
                   ranks, omp_get_max_threads(), kernel);
        fmt::print("{:22} {:13} {:6} {:>8} {:15} {:>9} {:22} {}\n", "collision",
                   "precision", "forced", "MLUPS", "[low high]", "copy GB/s",
                   "share of limit", "exchange");
    }
    for (const Precision precision : o.precisions) {
        for (const Collision collision : o.collisions) {
            for (const double forced : o.forced) {
                const Result r =
                    measure(MPI_COMM_WORLD, o.settings, {collision, precision, forced});
                report["results"].push_back(to_json(r));
                if (talk) print(r);
            }
        }
    }
    if (!o.peer.empty()) compare_with_peer(o, rank, ranks, report);
    if (rank == 0 && o.json) fmt::print("{}\n", report.dump(2));
}

}  // namespace
}  // namespace magfsi::bench

int main(int argc, char** argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    magfsi::bench::Options options;
    CLI::App app("Speed of the lattice Boltzmann fluid");
    magfsi::bench::declare(app, options);
    int code = 0;
    try {
        app.parse(argc, argv);
        magfsi::bench::run(options);
    } catch (const CLI::ParseError& error) {
        code = app.exit(error);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    magfsi::keep_libraries();
    MPI_Finalize();
    return code;
}
