// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/app/after_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "coupler/output/file.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

// Parts are texts of JSON arrays; merging them as texts needs no memory for their trees.
void merge_traces(const fs::path& out) {
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(out)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("trace_") && name.ends_with(".json"))
            parts.push_back(entry.path());
    }
    if (parts.empty()) return;
    std::ranges::sort(parts);
    // Each file holds a JSON array of events; their contents are joined to one array.
    std::string all = "[";
    for (const fs::path& part : parts) {
        std::ostringstream text;
        text << std::ifstream(part, std::ios::binary).rdbuf();
        const std::string events = text.str();
        const auto begin = events.find('['), end = events.rfind(']');
        if (begin == std::string::npos || end == std::string::npos) continue;
        if (all.size() > 1) all += ",";
        all += events.substr(begin + 1, end - begin - 1);
    }
    output::write_atomically(out / "trace.json", all + "]\n");
    for (const fs::path& part : parts) fs::remove(part);
}

namespace {

// Warns that the page's process could not be started. The run itself has ended well, so
// this is no error.
void no_page(const std::string& folder) {
    fmt::print(stderr, "warning: no page is written ({}); ./magfsi report {} writes it\n",
               std::strerror(errno), folder);
}

}  // namespace

// PYTHONPATH is set by ./magfsi, without which the package is not found.
void start_page(const scene::Scene& scene, const fs::path& out) {
    const char* const asked = std::getenv("MAGFSI_PAGE");
    if (scene.report == scene::PageAtEnd::off || !asked ||
        std::string_view(asked) != "yes" || !std::getenv("PYTHONPATH"))
        return;
    const std::string folder = out.string();
    std::fflush(nullptr);
    // The child inherits the lock of the run folder, and the next run would find the
    // folder taken. The pipe closes when the child has closed all inherited files
    // (close_range or exec), and the parent waits for that, not for the page.
    int inherited[2];
    if (::pipe2(inherited, O_CLOEXEC) != 0) return no_page(folder);
    if (const ::pid_t child = ::fork(); child != 0) {
        if (child < 0) {
            no_page(folder);
            ::close(inherited[0]);
            ::close(inherited[1]);
            return;
        }
        ::close(inherited[1]);
        char none;
        while (::read(inherited[0], &none, 1) < 0 && errno == EINTR) {
        }
        ::close(inherited[0]);
        fmt::print("the page {} is being written\n", (out / "report.html").string());
        return;
    }
    ::close_range(STDERR_FILENO + 1, ~0U, 0);
    ::setsid();  // the page is written even if the terminal closes
    // Nice value 10: other work goes first, but even on a busy machine the page gets
    // done.
    ::setpriority(PRIO_PROCESS, 0, 10);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        ::dup2(nothing, stream);
    ::execl("/usr/bin/python3", "/usr/bin/python3", "-P", "-m", "magfsi.report",
            "--after-run", "--", folder.c_str(), nullptr);
    ::_exit(1);
}

}  // namespace magfsi::launch
