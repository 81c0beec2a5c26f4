#include "coupler/output/pvd.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "coupler/output/atomic_file.h"
#include "coupler/output/number.h"
#include "coupler/output/relative_path.h"
#include "coupler/output/vtk_field.h"

namespace magfsi::output {

PvdSeries::PvdSeries(std::filesystem::path path) : path_(std::move(path)) {
    write();
}

void PvdSeries::add(double time_s, const std::filesystem::path& file) {
    if (!entries_.empty() && !(time_s > entries_.back().time_s))
        throw std::invalid_argument(fmt::format("{}: time {} s does not come after {} s",
                                                path_.string(), to_text(time_s),
                                                to_text(entries_.back().time_s)));
    entries_.push_back({time_s, relative_to(file, path_)});
    write();
}

void PvdSeries::write() const {
    std::string xml =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
        "<Collection>\n";
    for (const auto& [time_s, file] : entries_)
        xml += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                           to_text(time_s), xml_escaped(file));
    write_atomically(path_, xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace magfsi::output
