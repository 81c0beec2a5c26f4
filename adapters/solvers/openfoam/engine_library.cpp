// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/openfoam/engine_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "adapters/solvers/openfoam/explain.h"

namespace magfsi::openfoam {

namespace fs = std::filesystem;

namespace {

// OpenFOAM's libraries read etc/controlDict in this folder while they are being loaded.
constexpr const char* debian_project_folder = "/usr/share/openfoam";
constexpr const char* advice =
    "install it with apt-get install openfoam, build with ./magfsi build, or use "
    "fluid.solver: lbm";

// Path of the engine, in lib/ beside the folder of this executable.
fs::path library() {
    return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib" /
           "libmagfsi_openfoam_engine.so";
}

// WM_PROJECT_DIR of the user's environment, else Debian's folder.
fs::path project_folder() {
    const char* given = std::getenv("WM_PROJECT_DIR");
    return given ? given : debian_project_folder;
}

}  // namespace

// Looks for the engine's library and for OpenFOAM's controlDict.
std::string missing() {
    if (!fs::exists(library()))
        return fmt::format("this build has no OpenFOAM; {}", advice);
    const fs::path control = project_folder() / "etc" / "controlDict";
    if (!fs::exists(control))
        return fmt::format("OpenFOAM is not installed ({} is missing); {}",
                           control.string(), advice);
    return "";
}

// The library stays loaded until the process ends.
std::unique_ptr<Engine> load_engine(const EngineSetup& setup) {
    const std::string fault = missing();
    if (!fault.empty()) throw std::runtime_error("fluid.solver: openfoam: " + fault);
    setenv("WM_PROJECT_DIR", debian_project_folder, 0);
    // RTLD_GLOBAL lets OpenFOAM's libraries find each other's run-time selection tables
    // by name.
    void* handle = dlopen(library().c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!handle) {
        const char* why = dlerror();
        throw std::runtime_error(
            fmt::format("fluid.solver: openfoam: {}; {}", why, advice));
    }
    void* symbol = dlsym(handle, "magfsi_openfoam_engine");
    if (!symbol)
        throw std::runtime_error(
            fmt::format("fluid.solver: openfoam: {} is of another version; build it anew "
                        "with ./magfsi build",
                        library().string()));
    const auto make = reinterpret_cast<decltype(&magfsi_openfoam_engine)>(symbol);
    return std::unique_ptr<Engine>(make(setup));
}

}  // namespace magfsi::openfoam
