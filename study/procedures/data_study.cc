#include "study/procedures/data_study.h"

#include <fmt/format.h>

#include "study/procedures/pulse_start.h"
#include "study/procedures/two_mass_report.h"

namespace towbench::study::procedures {

ProcedureOutcome study_log(const ProcedureContext& context, const BroughtLog& log) {
  identify::TwoMassFit best;
  // Knots of the friction's map closer and closer, as far as the log bears them.
  for (const double spacing_m : {1.0, 0.5, 0.25, 0.12}) {
    const auto start = pulse_start(context, log.recording, spacing_m);
    auto fit = identify::fit_two_mass(start, log.recording, context.axis);
    const bool better = !best.converged || fit.residual_rms_counts < best.residual_rms_counts;
    if (!unexplained(best).empty() || (fit.converged && better)) {
      best = std::move(fit);
    }
    if (unexplained(best).empty() && !leaves_much(best)) {
      break;
    }
  }
  if (const auto why = unexplained(best); !why.empty()) {
    return ProcedureOutcome::failed(
        fmt::format("the two-mass model does not explain the {}: {}", log.source, why));
  }
  ProcedureOutcome outcome;
  report_two_mass({.context = context,
                   .data = log.recording,
                   .fit = best,
                   .knots_are_bends = false,
                   .procedure = "log",
                   .input = log.source},
                  outcome);
  return outcome;
}

}  // namespace towbench::study::procedures
