// [[requirement]] of an experiment file, read and written.
#pragma once

#include <string>
#include <vector>

#include "harness/experiment/experiment.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Throws FixtureError.
[[nodiscard]] std::vector<Requirement> read_requirements(
    TableReader& experiment, const std::vector<EvaluationWindow>& windows);
[[nodiscard]] std::string to_toml(const Requirement& requirement);

}  // namespace towbench::harness
