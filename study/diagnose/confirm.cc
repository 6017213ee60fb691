#include "study/diagnose/confirm.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/diagnose/axis_body.h"
#include "study/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A model in one run: its base parameters, and what its other terms take along the measured motion.
struct InRun {
  Baseline machine;
  Theta theta;
  ExtraForce extra;
};

InRun placed(const HeldOut& heldout, std::size_t i, const Context& context,
             const FittedModel& model) {
  const Dataset::Member& member = heldout.data().members[i];
  const VectorXd coefficients = heldout.coefficients_in(i, model);
  return {machine_with(heldout.data().baseline, model.terms, coefficients),
          coefficients.head<kBaseColumns>(),
          extra_force(member.signals, context, model.terms, coefficients)};
}

// Samples at which the windows of a run begin: where its rows follow each other without a gap for
// a whole window (no standstill, nothing missing or lost) inside the scored part.
std::vector<Index> window_starts(const Dataset::Member& member, const HeldOut::Rows& scored) {
  const Index samples = member.run.size();
  const VectorXd at =
      member.conditioner.at_rows(VectorXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)));
  const double window = kWindow_s / member.run.period_s;
  const double between = kBetweenStarts_s / member.run.period_s;
  std::vector<Index> starts;
  double next = -1;
  double unbroken_from = 0;
  double stride = 1e300;
  for (Index row = 1; row < at.size(); ++row) {
    stride = std::min(stride, at[row] - at[row - 1]);
  }
  for (Index row = scored.from; row < scored.from + scored.count; ++row) {
    if (row == scored.from || at[row] - at[row - 1] > 1.5 * stride) {
      unbroken_from = at[row];
    }
    const double start = std::ceil(at[row] - window);
    if (start >= unbroken_from && start >= next) {
      starts.push_back(static_cast<Index>(start));
      next = start + between;
    }
  }
  return starts;
}

// From the measured state under the measured input: metres off after a window.
double off_after_window_m(const Dataset::Member& member, const InRun& model, Index start) {
  const Run& run = member.run;
  const Signals& s = member.signals;
  const auto state = [&](const Signals& of) {
    return Motion{of.position_m[start], of.speed_m_per_s[start]};
  };
  AxisBody body(model.machine, model.theta, state(s),
                s.load != nullptr ? state(s.load->motion) : state(s));
  const Index end = start + static_cast<Index>(std::lround(kWindow_s / run.period_s));
  const auto steps = std::max(1, static_cast<int>(std::ceil(run.period_s / kLongestStep_s)));
  const double h = run.period_s / steps;
  for (Index k = start; k < end; ++k) {
    const double slope =
        model.machine.model.input_is_held ? 0.0 : run.input_N[k + 1] - run.input_N[k];
    for (int i = 0; i < steps; ++i) {
      const double w = (i + 0.5) / steps;
      const auto between = [&](const VectorXd& x) { return (1 - w) * x[k] + w * x[k + 1]; };
      const double known = run.known_N.size() == run.size() ? between(run.known_N) : 0.0;
      body.step(run.input_N[k] + w * slope - between(model.extra.on_motor_N) - known,
                -between(model.extra.on_load_N), h);
    }
  }
  return body.motor().position_m - s.position_m[end];
}

// What the law demands of the model beyond what it demanded of the machine, at the scored rows.
VectorXd force_error_N(const Dataset::Member& member, const HeldOut::Rows& scored,
                       const Run& reference) {
  return member.conditioner.column(reference.input_N - member.run.input_N)
      .segment(scored.from, scored.count);
}

struct Pair {
  std::vector<double> supplied;
  std::vector<double> extended;
  std::vector<Index> run_starts{0};

  void add(double before, double after) {
    supplied.push_back(before);
    extended.push_back(after);
  }
  void end_run() { run_starts.push_back(static_cast<Index>(supplied.size())); }
  [[nodiscard]] Improvement improvement(std::uint64_t seed) const {
    const auto vector = [](const std::vector<double>& v) {
      return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size())));
    };
    const Gain gain = gain_of(vector(supplied), vector(extended), run_starts, seed);
    return {gain.before_rms_N, gain.after_rms_N, gain.ci95};
  }
};

class Confirmer {
 public:
  Confirmer(const HeldOut& heldout, std::uint64_t seed) : heldout_(heldout), seed_(seed) {}

  Confirmation of(const std::vector<InRun>& supplied, const std::vector<InRun>& extended) {
    Confirmation c{.law = ControlLaw::Kind::kFitted};
    Pair way;
    Pair force;
    for (std::size_t i = 0; i < supplied.size(); ++i) {
      add_windows(i, supplied[i], extended[i], way);
      add_closed_loop(i, supplied[i], extended[i], force, c.law);
    }
    c.windows = way.run_starts.back();
    c.position_m = way.improvement(seed_);
    c.force_N = force.improvement(seed_);
    return c;
  }

 private:
  void add_windows(std::size_t i, const InRun& supplied, const InRun& extended, Pair& way) const {
    const Dataset& data = heldout_.data();
    for (const Index start : window_starts(data.members[i], heldout_.scored(i))) {
      way.add(off_after_window_m(data.members[i], supplied, start),
              off_after_window_m(data.members[i], extended, start));
    }
    way.end_run();
  }

  // Both models under one law: where the fitted one loses either, the stiff one holds both.
  void add_closed_loop(std::size_t i, const InRun& supplied, const InRun& extended, Pair& force,
                       ControlLaw::Kind& law) const {
    const Dataset::Member& member = heldout_.data().members[i];
    const auto reference = [&](const InRun& model, const ControlLaw& under) {
      return simulate_reference(member, model.theta, model.machine, model.extra, under, seed_ + i);
    };
    const ControlLaw found = find_control_law(member.run);
    SimulatedReference before = reference(supplied, found);
    SimulatedReference after = reference(extended, found);
    if (before.law != after.law) {
      before = reference(supplied, {});
      after = reference(extended, {});
    }
    if (after.law == ControlLaw::Kind::kTracking) {
      law = after.law;
    }
    const VectorXd off_before = force_error_N(member, heldout_.scored(i), before.run);
    const VectorXd off_after = force_error_N(member, heldout_.scored(i), after.run);
    for (Index row = 0; row < off_before.size(); ++row) {
      force.add(off_before[row], off_after[row]);
    }
    force.end_run();
  }

  const HeldOut& heldout_;
  std::uint64_t seed_;
};

}  // namespace

Confirmation confirm(const HeldOut& heldout, const Context& context, const FittedModel& supplied,
                     const FittedModel& extended, std::uint64_t seed) {
  std::vector<InRun> before;
  std::vector<InRun> after;
  for (std::size_t i = 0; i < heldout.data().members.size(); ++i) {
    before.push_back(placed(heldout, i, context, supplied));
    after.push_back(placed(heldout, i, context, extended));
  }
  return Confirmer(heldout, seed).of(before, after);
}

}  // namespace towbench::harness::diagnose
