// SPDX-License-Identifier: GPL-2.0-or-later
// Keeps the code of MPI's components in memory until the process has ended.
#pragma once

#include <dlfcn.h>
#include <link.h>

#include <string>
#include <vector>

namespace magfsi {

// To be called right before MPI_Finalize. That of Open MPI 4.1 unloads its PMIx component
// while a thread of its own still runs. A message of mpirun in that moment makes the
// thread call process_event() of the unloaded component: a segmentation fault after the
// run's work is done (once in some thousand runs; open-mpi/ompi issue 10117). Libraries
// marked here stay where they are.
inline void keep_libraries() {
    std::vector<std::string> names;
    // No dlopen in the callback, which holds the loader's lock.
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* list) {
            static_cast<std::vector<std::string>*>(list)->emplace_back(info->dlpi_name);
            return 0;
        },
        &names);
    for (const std::string& name : names)
        if (!name.empty()) dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

}  // namespace magfsi
