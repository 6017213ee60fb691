#include "harness/falsify/box_search.h"

#include <algorithm>
#include <cmath>
#include <exception>
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
    const double share = samples_alone ? 1 : std::clamp(settings_.uniform_share, 0.0, 1.0);
    const auto samples =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(settings_.runs)));
    core::Random random(settings_.seed);
    for (std::size_t i = 0; i < samples && !over(); ++i) {
      (void)take(uniform_point(random, settings_.variables), true);
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

  double take(const BoxPoint& point, bool uniform) {
    BoxTrial trial{.point = point, .uniform = uniform};
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
      return self.take(point, false);
    } catch (...) {  // NLopt would let through its own alone
      self.thrown_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }

  void optimise() {
    nlopt::srand(static_cast<unsigned long>(settings_.seed));
    const auto starts = best_samples();
    std::size_t next = 0;
    while (!over()) {
      const auto before = found_.trials.size();
      const auto& start = starts[next++ % starts.size()];
      run_optimiser(start, next <= starts.size() ? kFirstStep : kFirstStep / 8);
      if (found_.trials.size() == before) {
        return;  // it has nothing to try
      }
    }
  }

  void run_optimiser(BoxPoint point, double step) {
    nlopt::opt optimiser(algorithm(), static_cast<unsigned>(settings_.variables));
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_xtol_abs(kTolerance);
    optimiser.set_min_objective(&Search::evaluate, this);
    if (settings_.optimiser == Optimiser::kSubplex) {
      optimiser.set_initial_step(step);
    } else {
      optimiser.set_maxeval(static_cast<int>(settings_.runs));
    }
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

  // The best samples, none close to a better one.
  [[nodiscard]] std::vector<BoxPoint> best_samples() const {
    std::vector<const BoxTrial*> defined;
    for (const auto* trials : {&settings_.known, &found_.trials}) {
      for (const auto& trial : *trials) {
        if (trial.value) {
          defined.push_back(&trial);
        }
      }
    }
    std::stable_sort(defined.begin(), defined.end(),
                     [](const BoxTrial* a, const BoxTrial* b) { return *a->value < *b->value; });
    std::vector<BoxPoint> starts;
    for (const auto* trial : defined) {
      const bool apart = std::all_of(starts.begin(), starts.end(), [&](const BoxPoint& other) {
        return distance(other, trial->point) > kApart;
      });
      if (apart && starts.size() < kMostStarts) {
        starts.push_back(trial->point);
      }
    }
    if (starts.empty()) {
      starts.emplace_back(settings_.variables, 0.5);
    }
    return starts;
  }

  static double distance(const BoxPoint& a, const BoxPoint& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, std::fabs(a[i] - b[i]));
    }
    return largest;
  }

  static constexpr double kFirstStep = 0.05;
  static constexpr double kTolerance = 1e-5;
  static constexpr double kApart = 0.05;
  static constexpr std::size_t kMostStarts = 5;

  const BoxSearchSettings& settings_;
  const std::function<std::optional<double>(const BoxTrial&)>& measure_;
  BoxSearchResult found_;
  std::exception_ptr thrown_{};
};

}  // namespace

BoxPoint uniform_point(core::Random& random, std::size_t variables) {
  BoxPoint point(variables);
  std::generate(point.begin(), point.end(), [&] { return random.uniform(); });
  return point;
}

BoxSearchResult search_box(
    const BoxSearchSettings& settings,
    const std::function<std::optional<double>(const BoxTrial& trial)>& measure) {
  return Search(settings, measure).run();
}

}  // namespace towbench::harness
