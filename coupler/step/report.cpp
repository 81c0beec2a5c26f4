#include "coupler/step/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>

#include "coupler/output/memory.h"

namespace magfsi::coupler {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const output::FluidSummary& f) {
    return {{"cells", f.cells},         {"mlups", f.mlups},
            {"tau", f.relaxation_time}, {"spacing_m", f.spacing_m},
            {"collision", f.collision}, {"kernel", f.kernel}};
}

output::FluidSummary fluid_from(const Json& json) {
    return {json.at("cells"),     json.at("mlups"),     json.at("tau"),
            json.at("spacing_m"), json.at("collision"), json.at("kernel")};
}

Json to_json(const output::StructureSummary& s) {
    return {{"elements", s.elements},
            {"ns", s.ns_per_element_step},
            {"substeps", s.substeps_per_step}};
}

output::StructureSummary structure_from(const Json& json) {
    return {json.at("elements"), json.at("ns"), json.at("substeps")};
}

Json to_json(const SideLoad& load) {
    return {load.ranks,
            load.working_s,
            load.waiting_s,
            load.solver_s,
            load.immersed_boundary_s,
            load.output_s,
            load.imbalance,
            load.steps_s,
            load.most_ranks};
}

SideLoad load_from(const Json& json) {
    return {json.at(0), json.at(1), json.at(2), json.at(3), json.at(4),
            json.at(5), json.at(6), json.at(7), json.at(8)};
}

SideLoad load_of(const World& world, const std::vector<TaskTime>& tasks, double idle_s) {
    enum { working, waiting, solver, output, steps, values };
    std::array<double, values> mine{};
    double immersed_boundary_s = 0;
    for (const TaskTime& task : tasks) {
        const double work_s = task.seconds - task.waiting_s;
        mine[working] += work_s;
        mine[waiting] += task.waiting_s;
        mine[steps] += task.seconds;
        if (task.kind == TaskKind::solver) mine[solver] += work_s;
        if (task.kind == TaskKind::immersed_boundary) immersed_boundary_s += work_s;
        if (task.kind == TaskKind::output) mine[output] += work_s;
    }
    mine[working] -= idle_s;
    std::array<double, 2> most_s{mine[working], immersed_boundary_s};
    // Ranks wait for each other inside the solver: for the one that still samples and
    // spreads, which itself waits least.
    double least_solver_s = mine[solver];
    std::array<double, values> all = mine;
    MPI_Allreduce(MPI_IN_PLACE, all.data(), values, MPI_DOUBLE, MPI_SUM, world.local());
    MPI_Allreduce(MPI_IN_PLACE, most_s.data(), 2, MPI_DOUBLE, MPI_MAX, world.local());
    MPI_Allreduce(MPI_IN_PLACE, &least_solver_s, 1, MPI_DOUBLE, MPI_MIN, world.local());
    for (double& value : all) value /= world.size();
    SideLoad load{world.size(),   all[working], all[waiting],
                  least_solver_s, most_s[1],    all[output]};
    load.steps_s = all[steps];
    if (all[working] > 0) load.imbalance = most_s[0] / all[working];
    return load;
}

// What takes two sides: the summary of a run without a partner has none of it.
void add_balance(const Session& session, output::Summary& summary,
                 const ParticipantReport& structure, const ParticipantReport& fluid) {
    const Scheme scheme = session.plan().coupling->scheme;
    summary.coupling_overhead = coupling_overhead(scheme, structure.load, fluid.load);
    summary.immersed_boundary_share = immersed_boundary_share(structure.load, fluid.load);
    const auto cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    const auto better = advice(scheme, structure.load, fluid.load, summary.wall_s, cores);
    if (!better) return;
    summary.advice = *better;
    session.log(*better);
}

}  // namespace

ParticipantReport basic_report(const World& world, const TaskList& tasks, double idle_s) {
    ParticipantReport report;
    report.name = to_string(world.self());
    report.ranks = world.size();
    const std::vector<TaskTime> times = tasks.times();
    for (const TaskTime& task : times) {
        report.tasks.emplace_back(task.name, task.seconds);
        if (task.waiting_s > 0) report.waiting.emplace_back(task.name, task.waiting_s);
    }
    report.load = load_of(world, times, idle_s);
    const std::int64_t mine = output::peak_resident_bytes();
    MPI_Reduce(&mine, &report.memory_bytes, 1, MPI_INT64_T, MPI_SUM, 0, world.local());
    return report;
}

std::string to_text(const ParticipantReport& report) {
    Json json{{"name", report.name},          {"ranks", report.ranks},
              {"tasks", report.tasks},        {"waiting", report.waiting},
              {"load", to_json(report.load)}, {"memory_bytes", report.memory_bytes},
              {"versions", report.versions}};
    if (report.fluid) json["fluid"] = to_json(*report.fluid);
    if (report.structure) json["structure"] = to_json(*report.structure);
    return json.dump();
}

ParticipantReport report_from_text(const std::string& text) {
    const Json json = Json::parse(text);
    ParticipantReport report;
    report.name = json.at("name");
    report.ranks = json.at("ranks");
    report.tasks = json.at("tasks").get<output::Named<double>>();
    report.waiting = json.at("waiting").get<output::Named<double>>();
    report.load = load_from(json.at("load"));
    report.memory_bytes = json.at("memory_bytes");
    report.versions = json.at("versions").get<output::Named<std::string>>();
    if (json.contains("fluid")) report.fluid = fluid_from(json.at("fluid"));
    if (json.contains("structure"))
        report.structure = structure_from(json.at("structure"));
    return report;
}

std::unique_ptr<output::ProbeFile> open_probes(const Session& session,
                                               const std::vector<std::string>& columns) {
    const auto file = session.out() / "probes.csv";
    if (!session.restart()) return std::make_unique<output::ProbeFile>(file, columns);
    return std::make_unique<output::ProbeFile>(file, columns, session.clock().time_s());
}

std::string end_line(const Session& session, double wall_s) {
    if (session.stop_cause())
        return fmt::format("stopped: {}; go on with --restart latest",
                           *session.stop_cause());
    return fmt::format("done: {} steps in {:.1f} s; results in {}",
                       session.clock().steps_here(), wall_s, session.out().string());
}

void write_summary(const Session& session, std::span<const ParticipantReport> reports,
                   double wall_s, const output::ProbeFile* probes) {
    output::Summary summary;
    summary.scene = session.plan().name;
    summary.scene_hash = session.plan().scene_hash;
    summary.outcome = output::Outcome::completed;
    if (session.stop_cause()) {
        summary.outcome = output::Outcome::stopped;
        summary.cause = *session.stop_cause();
    }
    if (session.restart())
        summary.extra["restarted_at_step"] = session.clock().first_step();
    summary.effects = session.plan().effects;
    summary.absent_effects = session.plan().absent_effects;
    summary.steps = session.clock().step();
    summary.simulated_s = session.clock().time_s();
    summary.wall_s = wall_s;
    if (probes) {
        const auto last = probes->last_row();
        for (std::size_t i = 0; i < last.size(); ++i)
            summary.probes.emplace_back(probes->columns()[i], last[i]);
    }
    for (const ParticipantReport& report : reports) {
        summary.ranks.emplace_back(report.name, report.ranks);
        summary.tasks.emplace_back(report.name, report.tasks);
        summary.waiting.emplace_back(report.name, report.waiting);
        summary.load.emplace_back(
            report.name, output::LoadSummary{report.load.working_s, report.load.waiting_s,
                                             report.load.imbalance});
        summary.memory_bytes.emplace_back(report.name, report.memory_bytes);
        summary.versions.insert(summary.versions.end(), report.versions.begin(),
                                report.versions.end());
        if (report.fluid) summary.fluid = report.fluid;
        if (report.immersed_boundary)
            summary.immersed_boundary = report.immersed_boundary;
        if (report.energy_audit) summary.energy_audit = report.energy_audit;
        if (report.iterations) summary.iterations = report.iterations;
        if (report.structure) {
            summary.structure = report.structure;
            summary.substeps = report.structure->substeps.value_or(
                summary.steps * report.structure->substeps_per_step);
        }
    }
    if (reports.size() == 2) add_balance(session, summary, reports[0], reports[1]);
    output::write_summary(session.out() / "summary.json", summary);
}

}  // namespace magfsi::coupler
