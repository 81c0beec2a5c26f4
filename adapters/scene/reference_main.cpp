// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-scene-reference: prints docs/scene.md.
#include <cstdio>

#include "adapters/scene/schema.h"

// Exits with 1 if stdout cannot be written.
int main() {
    const std::string page = magfsi::scene::scene_reference_markdown();
    return std::fputs(page.c_str(), stdout) < 0 ? 1 : 0;
}
