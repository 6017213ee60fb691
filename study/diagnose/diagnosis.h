// From logs and a model to a verdict: the whole method of docs/theory/diagnosis.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/diagnose/free_run.h"
#include "study/diagnose/next_experiment.h"
#include "study/diagnose/parameters.h"
#include "study/diagnose/scored.h"
#include "study/diagnose/series.h"
#include "study/diagnose/stretches.h"
#include "study/diagnose/testability.h"
#include "study/diagnose/unexplained.h"
#include "study/logs/finding.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

using Progress = std::function<void(const std::string&)>;

struct Request {
  NominalModel model;
  std::vector<Run> runs;
  std::vector<Run> holdout;          // only scored, never fitted; none: the gain is cross-validated
  std::vector<Run> aside{};          // only asked how much worse they are predicted than `runs`
  std::vector<Stretch> stretches{};  // of `runs`, put aside likewise
  Progress progress{};
};

// A number that belongs to a cause. Known: a shaft's turn, which is not estimated.
struct Size {
  std::string name;  // with its unit
  Interval ci95;
  bool known = false;
};

struct NamedCause {
  const Effect* effect = nullptr;
  std::vector<Size> sizes;
  double p_value = 1;          // corrected for the number tried
  Interval gain99;             // its own, of the prediction error, over the best model without it
  double standard_errors = 0;  // of the gain above zero
  std::vector<std::string> alternatives{};  // that predict as well in its place
  std::optional<NextExperiment> separating{};

  // Of the size of that name; zero where there is none.
  [[nodiscard]] double size(const std::string& name) const;
};

struct Refused {
  std::string effect;
  double p_value = 1;
  Interval gain99;
};

// What was tried beside the causes, in the last round.
struct Considered {
  std::string effect;
  double p_value = 1;
  Interval gain99;
  double standard_errors = 0;  // of the gain above zero
  bool plausible = false;      // sign and size as its law allows
};

struct Diagnosis {
  std::vector<std::string> verdicts;  // model_adequate, parameters_off, cause_found, ...
  logs::Findings findings;            // a fatal one: nothing below is filled
  Context context;
  std::vector<NamedCause> causes;
  std::vector<Refused> refused;  // what the data speak for, and what was not accepted
  std::vector<Considered> considered;
  std::vector<std::string> dropped;  // effects that were accepted for a while
  std::vector<std::string> refuted;  // what a run speaks against
  std::vector<ParameterShift> parameters;
  bool estimated = false;  // the parameters: no model stated them
  std::optional<Unexplained> unexplained;
  std::vector<NotTestable> not_testable;
  Scored scored;
  FreeRun free_run;
  std::optional<Emulated> emulated;  // by whoever has a plant file
  Parameters extended;               // the model with what was found
  double bandwidth = 0;              // rad/s
  double innovations_m = 0;          // rms that is left
  std::vector<double> innovations_of_run_m;
  std::vector<double> stated_of_run_m;         // the same of the stated model
  std::vector<std::vector<double>> windows_m;  // the same of each window of each run
  Aside aside;
  std::vector<std::size_t> left_out;  // of the runs, those that something moves which no log has
  std::vector<Stretch> stretches;     // the same of the runs' stretches
  std::size_t tried = 0;
  Series series;  // for pictures
};

// Where something stays unexplained because of stretches or runs that are unlike the others, these
// are left out.
[[nodiscard]] Diagnosis diagnose(const Request& request);

}  // namespace towbench::study::diagnose
