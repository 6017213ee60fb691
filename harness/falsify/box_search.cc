#include "harness/falsify/box_search.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <stdexcept>

#include <nlopt.hpp>

namespace towbench::harness {
namespace {

// Where the function is undefined: worse than any margin.
constexpr double kUndefined = 1e9;

class Search {
 public:
  Search(const BoxSearchSettings& settings,
         const std::function<std::optional<double>(const BoxTrial&)>& measure)
      : settings_(settings), measure_(measure) {}

  BoxSearchResult run() {
    const bool samples_alone = settings_.optimiser == Optimiser::kUniform;
    const double share = samples_alone ? 1 : std::clamp(settings_.sampled_share, 0.0, 1.0);
    const auto samples =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(settings_.runs)));
    BoxSampler sampler(settings_.sides, settings_.seed, samples_alone);
    for (std::size_t i = 0; i < samples && !over(); ++i) {
      const auto sample = sampler.next();
      (void)take(sample.point, sample.kind);
    }
    if (!samples_alone) {
      optimise();
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool over() const {
    const bool reached = settings_.stop_below && found_.best &&
                         *found_.trials[*found_.best].value < *settings_.stop_below;
    return reached || found_.trials.size() >= settings_.runs;
  }

  double take(const BoxPoint& point, std::optional<SampleKind> sample) {
    BoxTrial trial{.point = point, .sample = sample};
    trial.value = measure_(trial);
    found_.trials.push_back(trial);
    if (trial.value && (!found_.best || *trial.value < *found_.trials[*found_.best].value)) {
      found_.best = found_.trials.size() - 1;
    }
    return trial.value.value_or(kUndefined);
  }

  static double evaluate(const std::vector<double>& point, std::vector<double>& /*gradient*/,
                         void* search) {
    auto& self = *static_cast<Search*>(search);
    if (self.over()) {
      throw nlopt::forced_stop();
    }
    try {
      return self.take(point, std::nullopt);
    } catch (...) {  // NLopt would let through its own alone
      self.thrown_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }

  void optimise() {
    nlopt::srand(static_cast<unsigned long>(settings_.seed));
    found_.begun = settings_.begun;
    while (!over()) {
      const auto before = found_.trials.size();
      if (const auto* start = best_sample()) {
        found_.begun.push_back(start->point);
        const auto best = found_.best;
        run_optimiser(start->point, first_steps(), kFirstRuns);
        if (found_.best != best && is_better_than_known(found_.best)) {
          run_optimiser(best_point(), BoxPoint(settings_.sides.size(), kSecondStep), kSecondRuns);
        }
      } else {
        run_optimiser(best_point(), BoxPoint(settings_.sides.size(), kLastStep), settings_.runs);
      }
      if (found_.trials.size() == before) {
        return;  // it has nothing to try
      }
    }
  }

  void run_optimiser(BoxPoint point, const BoxPoint& steps, std::size_t most_runs) {
    nlopt::opt optimiser(algorithm(), static_cast<unsigned>(settings_.sides.size()));
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_xtol_abs(kTolerance);
    optimiser.set_min_objective(&Search::evaluate, this);
    const bool is_local = settings_.optimiser == Optimiser::kSubplex;
    if (is_local) {
      optimiser.set_initial_step(steps);
    }
    optimiser.set_maxeval(static_cast<int>(is_local ? most_runs : settings_.runs));
    double value = 0;
    try {
      optimiser.optimize(point, value);
    } catch (const std::runtime_error&) {
      // Stopped, or as far as it goes from here.
    }
    if (thrown_) {
      std::rethrow_exception(thrown_);
    }
  }

  [[nodiscard]] nlopt::algorithm algorithm() const noexcept {
    switch (settings_.optimiser) {
      case Optimiser::kCrs:
        return nlopt::GN_CRS2_LM;
      case Optimiser::kDirect:
        return nlopt::GN_DIRECT_L;
      case Optimiser::kEsch:
        return nlopt::GN_ESCH;
      default:
        return nlopt::LN_SBPLX;
    }
  }

  // The best sample that is not close to where the optimiser has begun; none: there is no other.
  [[nodiscard]] const BoxTrial* best_sample() const {
    const BoxTrial* best = nullptr;
    for (const auto* trials : {&settings_.known, &found_.trials}) {
      for (const auto& trial : *trials) {
        const bool better = trial.sample && trial.value && (!best || *trial.value < *best->value);
        if (better && std::all_of(found_.begun.begin(), found_.begun.end(), [&](const auto& begun) {
              return distance(begun, trial.point) > kApart;
            })) {
          best = &trial;
        }
      }
    }
    return best;
  }

  static double distance(const BoxPoint& a, const BoxPoint& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, std::fabs(a[i] - b[i]));
    }
    return largest;
  }

  // Small in a time, large in a size.
  [[nodiscard]] BoxPoint first_steps() const {
    BoxPoint steps;
    std::transform(settings_.sides.begin(), settings_.sides.end(), std::back_inserter(steps),
                   [](const BoxSide& side) { return side.has_ends ? kStepOfSize : kStepOfTime; });
    return steps;
  }

  // The centre, where nothing was found.
  [[nodiscard]] BoxPoint best_point() const {
    return found_.best ? found_.trials[*found_.best].point : BoxPoint(settings_.sides.size(), 0.5);
  }

  // Better than all that was known before this search.
  [[nodiscard]] bool is_better_than_known(std::optional<std::size_t> trial) const {
    return trial &&
           std::all_of(settings_.known.begin(), settings_.known.end(), [&](const BoxTrial& known) {
             return !known.value || *found_.trials[*trial].value < *known.value;
           });
  }

  static constexpr double kStepOfTime = 0.02;
  static constexpr double kStepOfSize = 0.35;
  static constexpr std::size_t kFirstRuns = 20;  // from a sample
  // From the best, where that led to it.
  static constexpr double kSecondStep = 0.05;
  static constexpr std::size_t kSecondRuns = 40;
  static constexpr double kLastStep = 0.005;
  static constexpr double kTolerance = 1e-4;
  static constexpr double kApart = 0.02;

  const BoxSearchSettings& settings_;
  const std::function<std::optional<double>(const BoxTrial&)>& measure_;
  BoxSearchResult found_;
  std::exception_ptr thrown_{};
};

}  // namespace

BoxSearchResult search_box(
    const BoxSearchSettings& settings,
    const std::function<std::optional<double>(const BoxTrial& trial)>& measure) {
  return Search(settings, measure).run();
}

}  // namespace towbench::harness
