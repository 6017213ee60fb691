// What a cable for lines cannot carry of a machine: it has the nine of two axes.
#pragma once

#include <string>

#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {

// `option`: "--lines" or "--encoder-lines", with what it was given; empty: nothing is wired. Throws
// FixtureError.
void refuse_what_lines_cannot_carry(const std::string& option, const std::string& given,
                                    const emulator::RigParameters& rig);

}  // namespace towbench::harness
