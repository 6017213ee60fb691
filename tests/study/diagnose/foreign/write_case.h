// A case as files, to be looked at with other tools: a CSV log a run, its column map, the plant as
// it is stated, and the truth.
#pragma once

#include <filesystem>

#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {

void write_case(const DrawnCase& one, const std::filesystem::path& folder);

}  // namespace towbench::tests::foreign
