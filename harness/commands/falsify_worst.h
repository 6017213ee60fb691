// The worst case that a search found, as a run folder with its report, and as an experiment to
// keep.
#pragma once

#include "harness/commands/falsify_options.h"
#include "harness/falsify/shrink_case.h"

namespace towbench::harness {

// The exit code: whether what is asked is broken.
[[nodiscard]] int report_worst(const FalsifyOptions& options, const ExperimentFixture& fixture,
                               const Asked& asked, const CandidateController& controller,
                               const ShrunkCase& worst);

}  // namespace towbench::harness
