// From logs and a model to a verdict: the whole method of docs/theory/diagnosis.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/diagnose/confirm.h"
#include "study/diagnose/finding.h"
#include "study/diagnose/lack_of_fit.h"
#include "study/diagnose/next_experiment.h"
#include "study/diagnose/parameters.h"
#include "study/diagnose/selection.h"
#include "study/diagnose/testability.h"

namespace towbench::harness::diagnose {

struct Request {
  NominalModel model;
  std::vector<Run> runs;
  // None: the last of several runs, or every fourth stretch of the only one.
  std::vector<Run> holdout;
  std::uint64_t seed = 1;
  Progress progress;
};

struct Diagnosis {
  std::vector<std::string> verdicts;  // model_adequate, parameters_off, cause_found, ...
  Findings findings;                  // a fatal one: nothing below is filled
  Context context;
  Selection selection;
  std::vector<ParameterShift> parameters;
  std::optional<Unexplained> unexplained;
  std::vector<NotTestable> not_testable;
  std::vector<std::optional<NextExperiment>> separating;  // one a cause, where it has alternatives
  // Of refit and causes together over the model as it was supplied, on held-out data.
  Gain gain_over_supplied;
  Confirmation confirmed;                  // the same, simulated
  std::optional<double> lap_to_lap_rms_N;  // of repeats of the reference: a floor without a model
  double heldout_force_rms_N = 0;
  bool heldout_same_session = false;
  Dataset data;  // what the fit saw; for pictures
};

[[nodiscard]] Diagnosis diagnose(const Request& request);

}  // namespace towbench::harness::diagnose
