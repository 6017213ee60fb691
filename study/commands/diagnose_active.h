// towbench diagnose --active: the bench answers what the logs leave open (harness/active).
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "study/commands/diagnose_logs.h"

namespace towbench::study {

struct ActiveOptions {
  bool wanted = false;
  std::string rig;  // empty: the copy in the first run folder
  int most_rounds = 3;
};

void add_active_options(CLI::App& verb, ActiveOptions& options);

// Exit code: 0 answered, 1 a separating experiment did not pass, 3 stopped before its end.
// Throws UnusableData, FixtureError.
[[nodiscard]] int diagnose_and_run(const DiagnoseOptions& options, const ActiveOptions& active);

}  // namespace towbench::study
