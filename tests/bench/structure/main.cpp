// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-bench-structure [--json] [--rounds N]: nanoseconds an element of whole LAMMPS
// steps, 10,000 elements, one rank: the kernels of fix magttice against the plain form of
// the same element, in turns within one run, so that both meet the same state of the
// machine.
#include <mpi.h>
#include <stdlib.h>
#include <time.h>
#include "atom.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/process/keep_libraries.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/script.h"
#include "structure/lattice/plain_element.h"
#include "structure/lattice/stable_step.h"
#include "structure/mesh/block_mesh.h"

namespace {

using namespace magfsi::structure;
using LAMMPS_NS::LAMMPS;

// fix ID group bench/plain FILE G K ELEMENT: the forces of fix magttice, element by
// element in the plainest form. What the fast kernel is measured against.
class PlainLattice : public LAMMPS_NS::Fix {
  public:
    PlainLattice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    int setmask() override;
    void setup_pre_reverse(int, int) override { add_forces(); }
    void pre_reverse(int, int) override { add_forces(); }

  private:
    void add_forces();

    Material material_;
    std::vector<Hexahedron> elements_;  // node n is atom n + 1
    std::vector<ElementReference> reference_;
};

PlainLattice::PlainLattice(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    if (narg != 7) throw std::invalid_argument("fix bench/plain takes four arguments");
    const LatticeFile file = read_lattice_file(arg[3]);
    material_.shear_modulus_pa = std::stod(arg[4]);
    material_.lame_lambda_pa = std::stod(arg[5]);
    elements_ = file.elements;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        reference_.push_back(element_reference(gather(file.nodes_m, elements_[e]),
                                               parse_element_name(arg[6]),
                                               static_cast<int>(e)));
    }
}

int PlainLattice::setmask() {
    return LAMMPS_NS::FixConst::PRE_REVERSE;
}

// One rank: every node is a local atom.
void PlainLattice::add_forces() {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
        std::array<int, 8> atoms{};
        Positions8 x;
        for (int a = 0; a < 8; ++a) {
            atoms[static_cast<std::size_t>(a)] =
                atom->map(elements_[e][static_cast<std::size_t>(a)] + 1);
            for (int d = 0; d < 3; ++d) {
                x(a, d) = atom->x[atoms[static_cast<std::size_t>(a)]][d];
            }
        }
        const ElementState state = element_energy(reference_[e], material_, x);
        for (int a = 0; a < 8; ++a) {
            for (int d = 0; d < 3; ++d) {
                atom->f[atoms[static_cast<std::size_t>(a)]][d] += state.force_n(a, d);
            }
        }
    }
}

int rounds = 15;  // of each variant; their median and quartiles are printed
constexpr int steps_a_round = 20;

Body sheet(ElementVariant variant) {
    Body body;
    body.name = "sheet";
    body.mesh = box_mesh({{9.25e-3, 9.25e-3, 0.37e-3}, {50, 50, 4}});
    body.material = {33e3, 660e3, 1860};
    body.element = variant;
    return body;
}

LAMMPS_NS::Fix* create_plain(LAMMPS* lammps, int narg, char** arg) {
    return new PlainLattice(lammps, narg, arg);
}

// Steps once so that the body vibrates in both forms alike.
std::unique_ptr<LAMMPS> started(const std::vector<std::string>& lines) {
    std::array<std::string, 6> words{"bench",   "-log", "none",
                                     "-screen", "none", "-nocite"};
    std::array<char*, 6> arguments{};
    for (std::size_t i = 0; i < 6; ++i) arguments[i] = words[i].data();
    auto lammps = std::make_unique<LAMMPS>(6, arguments.data(), MPI_COMM_SELF);
    register_styles(*lammps);
    (*lammps->modify->fix_map)["bench/plain"] = &create_plain;
    for (const std::string& line : lines) lammps->input->one(line);
    lammps->input->one("velocity all create 1e10 4711 dist gaussian");
    lammps->input->one("velocity all zero linear");
    lammps->input->one("run 10");
    return lammps;
}

double processor_ns() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

// Of processor time: on one rank that never waits it is the time of a quiet machine, but
// for caches and memory that others use as well.
double ns_an_element(LAMMPS& lammps, std::size_t elements) {
    const double begin = processor_ns();
    lammps.input->one("run " + std::to_string(steps_a_round) + " pre no post no");
    return (processor_ns() - begin) / (steps_a_round * static_cast<double>(elements));
}

struct Spread {
    double median, low, high;  // low and high: quartiles
};

Spread spread_of(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return {values[n / 2], values[n / 4], values[(3 * n) / 4]};
}

struct Figures {
    Spread fast, plain, ratio;
};

Figures measure(ElementVariant variant, const std::filesystem::path& folder) {
    LammpsInput input;
    input.bodies = {sheet(variant)};
    input.time_step_s = 0.5 * stable_step_s(input.bodies[0]);
    auto lines = write_lammps_input(input, folder).setup;
    const auto fast = started(lines);
    for (std::string& line : lines) {
        if (!line.starts_with("fix magttice_")) continue;
        line = "fix plain all bench/plain \"" + (folder / "sheet.lattice").string() +
               "\" 33e3 660e3 " + std::string(magfsi::name_of(variant));
    }
    const auto plain = started(lines);
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> ratio;
    const std::size_t elements = input.bodies[0].mesh.elements.size();
    for (int round = 0; round < rounds; ++round) {
        a.push_back(ns_an_element(*fast, elements));
        b.push_back(ns_an_element(*plain, elements));
        ratio.push_back(b.back() / a.back());
    }
    return {spread_of(a), spread_of(b), spread_of(ratio)};
}

void print(ElementVariant variant, const Figures& f, bool json, bool last) {
    const char* name = magfsi::name_of(variant).data();
    if (json) {
        std::printf(
            "  \"%s\": {\"ns_per_element_step\": [%.2f, %.2f, %.2f], "
            "\"plain_ns_per_element_step\": [%.2f, %.2f, %.2f], "
            "\"times_faster\": [%.3f, %.3f, %.3f]}%s\n",
            name, f.fast.median, f.fast.low, f.fast.high, f.plain.median, f.plain.low,
            f.plain.high, f.ratio.median, f.ratio.low, f.ratio.high, last ? "" : ",");
        return;
    }
    std::printf(
        "%-15s %6.1f (%.1f to %.1f) ns an element, plain %6.1f (%.1f to %.1f), "
        "%.2f (%.2f to %.2f) times faster\n",
        name, f.fast.median, f.fast.low, f.fast.high, f.plain.median, f.plain.low,
        f.plain.high, f.ratio.median, f.ratio.low, f.ratio.high);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Speed of the structure: nanoseconds an element of whole LAMMPS steps"};
    bool json = false;
    app.add_flag("--json", json);
    app.add_option("--rounds", rounds)->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    MPI_Init(nullptr, nullptr);
    std::string name = std::filesystem::temp_directory_path() / "magfsi.XXXXXX";
    if (mkdtemp(name.data()) == nullptr) return 1;
    const std::array variants{ElementVariant::full, ElementVariant::assumed_strain};
    if (json) std::printf("{\n");
    for (ElementVariant variant : variants) {
        print(variant, measure(variant, name), json, variant == variants.back());
    }
    if (json) std::printf("}\n");
    std::filesystem::remove_all(name);
    magfsi::keep_libraries();
    MPI_Finalize();
    return 0;
}
