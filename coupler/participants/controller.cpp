// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/participants/controller.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "coupler/participants/errors.h"
#include "coupler/participants/waiting.h"

namespace magfsi::coupler {

namespace {

// Tag of the messages to and from the controller.
constexpr int tag = 76;
// Time [s] added to the controller's own limit: its alarm comes first and leaves the
// place where it hangs.
constexpr double grace_s = 1;
// First byte of an answer without an error; after any other byte the text is a traceback.
constexpr char good = '=';

// Bytes that checkpoints store as numbers.
std::string bytes_of(std::span<const double> numbers) {
    std::string bytes;
    for (const double number : numbers) bytes += static_cast<char>(number);
    return bytes;
}

void append(std::string& message, const void* data, std::size_t size) {
    message.append(static_cast<const char*>(data), size);
}

std::string receive(MPI_Comm comm) {
    MPI_Status status;
    MPI_Probe(0, tag, comm, &status);
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string message(size, ' ');
    MPI_Recv(message.data(), size, MPI_BYTE, 0, tag, comm, MPI_STATUS_IGNORE);
    return message;
}

}  // namespace

// Kind of a request: the first byte of the message, the same in controller.py.
enum class Controller::Request : char {
    begin = 'b',    // a plan in JSON
    restore = 'r',  // a state
    step = 's',     // step, time, probes; the answer is the field
    keep = 'k',     // the answer is a state
    end = 'e'
};

Controller::Controller(const World& world, const ControlPlan& plan,
                       const std::string& out, bool keeps,
                       std::optional<std::vector<double>> state)
    : world_(world), plan_(plan) {
    if (!world_.root()) return;
    const nlohmann::json begin{{"script", plan.script},
                               {"probes", plan.probes},
                               {"timeout_s", plan.timeout_s},
                               {"out", out},
                               {"keeps", keeps},
                               {"restored", state.has_value()}};
    // The first message of a controller names the file of its trace.
    trace_ = answer("word of the controller");
    request(Request::begin, begin.dump(), "start of the controller");
    if (state) request(Request::restore, bytes_of(*state), "controller to go on");
}

std::string Controller::ask(std::int64_t step, double time_s,
                            std::span<const double> probes) {
    std::string answer;
    if (world_.root()) {
        std::string content;
        append(content, &step, sizeof step);
        append(content, &time_s, sizeof time_s);
        append(content, probes.data(), probes.size_bytes());
        answer = request(Request::step, content,
                         fmt::format("answer of the controller at t = {:.6g} s", time_s));
    }
    int size = answer.size();
    MPI_Bcast(&size, 1, MPI_INT, 0, world_.local());
    answer.resize(size);
    MPI_Bcast(answer.data(), size, MPI_CHAR, 0, world_.local());
    return answer;
}

std::vector<double> Controller::keep() {
    if (!world_.root()) return {};
    const std::string state =
        request(Request::keep, "", "state of the controller for a checkpoint");
    const auto* first = reinterpret_cast<const unsigned char*>(state.data());
    return {first, first + state.size()};
}

void Controller::end() {
    if (world_.root()) request(Request::end, "", "end of the controller");
}

std::string Controller::request(Request kind, std::string_view content,
                                const std::string& what) {
    std::string message(1, static_cast<char>(kind));
    message += content;
    MPI_Request sending;
    MPI_Isend(message.data(), message.size(), MPI_BYTE, 0, tag, world_.controller(),
              &sending);
    wake(world_.controller_process());
    std::string found = answer(what);
    wait_all({&sending, 1}, plan_.timeout_s, what);
    return found;
}

std::string Controller::answer(const std::string& what) {
    try {
        constexpr std::array first{0};
        wait_for_messages(world_.controller(), first, tag, plan_.timeout_s + grace_s,
                          what, to_string(Role::control));
    } catch (const TimedOut&) {
        fail_late(what);
    }
    const std::string found = receive(world_.controller());
    if (found.starts_with(good)) return found.substr(1);
    throw std::runtime_error(found.substr(1));
}

// The trace ends where the user's script ends and controller.py begins.
void Controller::fail_late(const std::string& what) const {
    std::string where;
    std::ifstream file(trace_);
    for (std::string line; std::getline(file, line);) {
        if (line.find("magfsi/controller.py") != std::string::npos) break;
        where += "\n" + line;
    }
    throw std::runtime_error(
        fmt::format("no {} within {:g} s (control.timeout); it is here:{}", what,
                    plan_.timeout_s, where));
}

}  // namespace magfsi::coupler
