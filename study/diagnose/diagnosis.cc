#include "study/diagnose/diagnosis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/diagnose/aliased_effects.h"
#include "study/diagnose/context.h"
#include "study/diagnose/known_terms.h"
#include "study/diagnose/model_checks.h"
#include "study/diagnose/run_checks.h"
#include "study/diagnose/score.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;

constexpr Index kFewestRows = 60;

// Of the only run of a diagnosis every fourth stretch is held out, to be scored on at the end.
// Short ones: each part must have something of every kind of motion.
constexpr Index kStretches = 48;
constexpr Index kEveryNth = 4;

// Of an elastic axis's fit.
constexpr int kMostRounds = 8;
constexpr double kMoved = 0.002;   // relative; less is linear
constexpr double kFarthest = 1.2;  // a round may move a coefficient by this factor
// Of its chain.
constexpr int kMostReadings = 3;
constexpr double kChainMoved = 0.03;

bool everywhere(Index /*row*/, Index /*rows*/) {
  return true;
}
bool held_out(Index row, Index rows) {
  return (row * kStretches / rows) % kEveryNth == kEveryNth - 1;
}
bool not_held_out(Index row, Index rows) {
  return !held_out(row, rows);
}

struct Split {
  Dataset fit;      // causes are looked for and fitted here,
  Dataset heldout;  // and scored here: the second half of another run, or parts of the only one
  bool same_session = false;
};

Split split(const Request& request, const Baseline& baseline) {
  std::vector<Run> runs = request.runs;
  std::vector<Run> holdout = request.holdout;
  std::vector<Run> all = runs;
  all.insert(all.end(), holdout.begin(), holdout.end());
  const Conditioning conditioning = choose_conditioning(all, request.model);
  take_off_known_terms(runs, baseline, conditioning);
  take_off_known_terms(holdout, baseline, conditioning);
  if (holdout.empty() && runs.size() > 1) {
    holdout.push_back(runs.back());
    runs.pop_back();
  }
  if (!holdout.empty()) {
    return {make_dataset(runs, conditioning, baseline, everywhere),
            make_dataset(holdout, conditioning, baseline, everywhere), false};
  }
  return {make_dataset(runs, conditioning, baseline, not_held_out),
          make_dataset(runs, conditioning, baseline, held_out), true};
}

// An elastic axis is not linear in its mass: its base columns are taken again where the fit lies,
// until that is where they were taken.
Split split_around_the_fit(const Request& request, const ChainShift& read) {
  Baseline baseline = stated_baseline(request.model);
  baseline.read = read;
  Split data = split(request, baseline);
  for (int round = 0; request.model.elastic() && round < kMostRounds; ++round) {
    if (data.fit.rows() < kFewestRows) {
      break;
    }
    const Theta fitted = make_context(request.model, data.fit).theta;
    const Theta off = (fitted - baseline.at).cwiseAbs();
    if (off[kMass] < kMoved * baseline.at[kMass] &&
        off[kCoulomb] < kMoved * baseline.at[kCoulomb] &&
        off[kViscous] < kMoved * baseline.at[kViscous]) {
      break;
    }
    for (const auto j : {kMass, kViscous, kCoulomb}) {
      const double stated = baseline.at[j];
      baseline.at[j] = std::clamp(fitted[j], stated / kFarthest, stated * kFarthest);
    }
    baseline.at[kBias] = fitted[kBias];
    data = split(request, baseline);
  }
  return data;
}

// The data as read with one chain, and what was found in it.
struct Reading {
  Split data;
  Context context;
  Selection selection;

  [[nodiscard]] ChainShift chain() const {
    return chain_shift(selection.terms(), selection.after.coefficients);
  }
  [[nodiscard]] double left_share() const {
    const Evidence& e = selection.after;
    return e.residual.norm() / std::sqrt(static_cast<double>(e.y.size())) / e.force_rms_N;
  }
};

void look_for_causes(Reading& reading, const Request& request) {
  const HeldOut other_run(reading.data.heldout, reading.context, kGateOfAnotherSession);
  reading.selection =
      select_causes(reading.data.fit, reading.data.same_session ? nullptr : &other_run,
                    reading.context, request.seed, request.progress);
}

// A chain other than stated shows the load elsewhere: its speed is wrong with its place, and what
// hangs on either is found beside the chain. So the load is read again with the chain that was
// found, until it is the one it was read with, as long as that leaves less.
void read_again(Reading& reading, const Request& request) {
  for (int round = 0; round < kMostReadings; ++round) {
    const ChainShift found = reading.chain();
    const ChainShift off = (found - reading.data.fit.baseline.read).cwiseAbs();
    if (off[kStiffness] < kChainMoved && off[kPlay] <= kChainMoved * found[kPlay]) {
      return;
    }
    Reading again{split_around_the_fit(request, found), {}, {}};
    if (std::min(again.data.fit.rows(), again.data.heldout.rows()) < kFewestRows) {
      return;
    }
    again.context = make_context(request.model, again.data.fit);
    look_for_causes(again, request);
    if (again.chain().isZero(0) || again.left_share() > reading.left_share()) {
      return;
    }
    reading = std::move(again);
  }
}

// Force that repeats with the reference differs from lap to lap by noise alone.
std::optional<double> lap_noise_N(const Dataset& data) {
  const Run& run = data.members.front().run;
  const Eigen::VectorXd& r = run.reference_m;
  const Index n = run.size();
  if (r.size() != n) {
    return std::nullopt;
  }
  const double span = r.maxCoeff() - r.minCoeff();
  for (Index lap = n / 12; lap <= n / 2; ++lap) {
    bool same = span > 0;
    for (Index i = lap; i < n && same; i += 7) {
      same = std::abs(r[i] - r[i - lap]) < 1e-6 * span;
    }
    if (same) {
      const auto filter = ZeroPhaseFilter::sharp(data.conditioning.cutoff_Hz, 1 / run.period_s);
      const Eigen::VectorXd u = filter.apply(run.input_N);
      // The first lap starts from rest and is no repeat.
      const Index from = std::min(2 * lap, n - 1);
      const Eigen::VectorXd d = u.tail(n - from) - u.segment(from - lap, n - from);
      return n - from > lap / 2 ? std::optional<double>(std::sqrt(
                                      d.squaredNorm() / (2.0 * static_cast<double>(d.size()))))
                                : std::nullopt;
    }
  }
  return std::nullopt;
}

// Whether the columns are what they are said to be is asked of a rigid body: it has no fit that
// could wander off to meet them.
void check_against_rigid(const Request& request, const Conditioning& conditioning,
                         Findings& findings) {
  NominalModel rigid = request.model;
  rigid.chain = {};
  const Dataset plain =
      make_dataset(request.runs, conditioning, stated_baseline(rigid), everywhere);
  if (plain.rows() >= kFewestRows) {
    check_against_model(plain, make_context(rigid, plain), findings);
  }
}

void check_data(Request& request, Findings& findings) {
  for (auto* runs : {&request.runs, &request.holdout}) {
    for (Run& run : *runs) {
      check_run(run, request.model, findings);
    }
  }
  if (!is_fatal(findings)) {
    check_against_rigid(request, choose_conditioning(request.runs, request.model), findings);
  }
}

std::string lost_samples(const std::vector<Run>& runs) {
  double lost = 0;
  double all = 0;
  for (const Run& run : runs) {
    lost += static_cast<double>(std::count(run.missing.begin(), run.missing.end(), 1));
    all += static_cast<double>(run.size());
  }
  return lost > 0 ? fmt::format(" (gaps take {:.1f} % of the samples and their surroundings)",
                                100 * lost / all)
                  : "";
}

// A log in the wrong unit looks like one without motion: its noise would drown a true one's forces.
void explain_lack_of_rows(const Request& request, const Split& data, Findings& findings) {
  Conditioning widest;
  for (const Run& run : request.runs) {
    widest.cutoff_Hz = std::min(widest.cutoff_Hz, 0.2 / run.period_s);
    widest.smoothing_Hz = std::min(widest.smoothing_Hz, 0.4 / run.period_s);
  }
  check_against_rigid(request, widest, findings);
  for (Finding& finding : findings) {
    if (finding.name == "reference_unit_off") {
      finding.kind = Finding::Kind::kFatal;  // now it is the position that must be meant
    }
  }
  if (!is_fatal(findings)) {
    findings.push_back({Finding::Kind::kFatal, "too_little_motion",
                        fmt::format("{} independent samples in motion to fit and {} to judge on, "
                                    "{} of each are needed{}: log longer, or give another run",
                                    data.fit.rows(), data.heldout.rows(), kFewestRows,
                                    lost_samples(request.runs))});
  }
}

void conclude(Diagnosis& d) {
  const bool moved = std::any_of(d.parameters.begin(), d.parameters.end(),
                                 [](const ParameterShift& shift) { return shift.moved; });
  if (moved) {
    d.verdicts.emplace_back("parameters_off");
  }
  if (!d.selection.causes.empty()) {
    d.verdicts.emplace_back("cause_found");
  }
  if (d.unexplained) {
    d.verdicts.emplace_back("unexplained_structure");
  }
  if (d.verdicts.empty()) {
    d.verdicts.emplace_back("model_adequate");
  }
}

}  // namespace

Diagnosis diagnose(const Request& given) {
  Diagnosis d;
  Request request = given;
  const auto tell = [&](const char* what_next) {
    if (request.progress) {
      request.progress(what_next);
    }
  };
  tell("are the columns what they are said to be");
  check_data(request, d.findings);
  if (is_fatal(d.findings)) {
    return d;
  }
  tell("fitting the model as it is");
  Reading reading{split_around_the_fit(request, ChainShift::Zero()), {}, {}};
  const Split& data = reading.data;
  if (std::min(data.fit.rows(), data.heldout.rows()) < kFewestRows) {
    explain_lack_of_rows(request, data, d.findings);
    return d;
  }
  reading.context = make_context(request.model, data.fit);
  tell("looking for causes");
  look_for_causes(reading, request);
  read_again(reading, request);
  d.context = reading.context;
  d.selection = std::move(reading.selection);
  d.data = data.fit;
  const HeldOut heldout(data.heldout, d.context,
                        data.same_session ? kSameSession : kRestOfAnotherSession);
  tell("scoring on data not yet seen");
  refit_and_score(d.selection, data.fit, heldout, d.context, request.seed, data.same_session);
  const FittedModel supplied{{}, Eigen::VectorXd(stated_baseline(request.model).at)};
  const FittedModel extended{d.selection.terms(), d.selection.after.coefficients};
  d.gain_over_supplied =
      heldout.gain(heldout.residual(supplied), heldout.residual(extended), request.seed);
  tell("simulating both models");
  d.confirmed = confirm(heldout, d.context, supplied, extended, request.seed);
  d.parameters = judge_parameters(request.model, d.selection.after, d.selection.terms());
  tell("what is left, and what the data cannot show");
  find_aliased_effects(d.parameters, d.selection);
  d.unexplained = find_unexplained(data.fit, d.selection.after);
  d.not_testable = find_not_testable(d.selection);
  tell("what would separate causes");
  for (const Cause& cause : d.selection.causes) {
    d.separating.push_back(cause.alternatives.empty()
                               ? std::nullopt
                               : separate(data.fit, d.context, cause, cause.alternatives.front()));
  }
  d.lap_to_lap_rms_N = lap_noise_N(data.fit);
  d.heldout_force_rms_N = heldout.force_rms_N();
  d.heldout_same_session = data.same_session;
  conclude(d);
  return d;
}

}  // namespace towbench::harness::diagnose
