#include "harness/fault_cases/truth_phases.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness {
namespace {

using core::Nanoseconds;

constexpr Nanoseconds kStep_ns = 5 * core::kNanosecondsPerMillisecond;
constexpr std::size_t kForSpeed = 2;    // steps on either side
constexpr std::size_t kForChange = 10;  // also the shortest way from one direction to the other
constexpr std::size_t kForDrive = 4;    // a PWM may show zero for a moment
constexpr Nanoseconds kShortest_ns = 40 * core::kNanosecondsPerMillisecond;
constexpr double kStands_m_per_s = 5e-3;
constexpr double kChanges_m_per_s = 5e-3;
constexpr double kTrembles_m_per_s = 1e-3;  // an axis that is held
constexpr double kShareOfPeak = 0.1;        // for motions that are slow throughout

// A record thinned out to one sample in `kStep_ns`.
class Motion {
 public:
  Motion(const CaseRecord& run, core::Axis axis) {
    const auto& truth = run.truth;
    if (truth.empty()) {
      return;
    }
    const double metres_per_motor_rad = ratio_of(truth, axis);
    Nanoseconds next_ns = truth.front().time_ns;
    bool driven = false;
    for (const auto& row : truth) {
      driven = driven || row.axes[axis].command_V != 0.0;
      if (row.time_ns >= next_ns) {
        time_ns_.push_back(row.time_ns);
        place_m_.push_back(row.axes[axis].motor_angle_rad * metres_per_motor_rad);
        driven_.push_back(driven);
        driven = false;
        next_ns += kStep_ns;
      }
    }
    for (std::size_t i = 0; i < size(); ++i) {
      const auto from = before(i, kForSpeed);
      const auto to = after(i, kForSpeed);
      const double span_s = core::seconds(time_ns_[to] - time_ns_[from]);
      speed_m_per_s_.push_back(span_s > 0 ? (place_m_[to] - place_m_[from]) / span_s : 0.0);
      peak_m_per_s_ = std::max(peak_m_per_s_, std::fabs(speed_m_per_s_.back()));
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return time_ns_.size(); }
  [[nodiscard]] Nanoseconds time_ns(std::size_t i) const { return time_ns_[i]; }

  [[nodiscard]] std::string_view phase(std::size_t i) const {
    if (turns(i)) {
      return "reverse";
    }
    if (stands(i)) {
      return driven(i) ? "hold" : "rest";
    }
    const double change = std::fabs(speed_m_per_s_[after(i, kForChange)]) -
                          std::fabs(speed_m_per_s_[before(i, kForChange)]);
    if (std::fabs(change) < std::min(kChanges_m_per_s, kShareOfPeak * peak_m_per_s_)) {
      return "cruise";
    }
    return change > 0 ? "accelerate" : "decelerate";
  }

 private:
  // The motor's side of the transmission moves more evenly than the carriage.
  static double ratio_of(const std::vector<KeptTruth>& truth, core::Axis axis) {
    const auto way = [&](auto value) {
      const auto [low, high] = std::minmax_element(
          truth.begin(), truth.end(),
          [&](const auto& a, const auto& b) { return value(a.axes[axis]) < value(b.axes[axis]); });
      return value(high->axes[axis]) - value(low->axes[axis]);
    };
    const double carriage_m = way([](const auto& one) { return one.carriage_m; });
    const double motor_rad = way([](const auto& one) { return one.motor_angle_rad; });
    return motor_rad > 0 ? carriage_m / motor_rad : 0.0;
  }

  [[nodiscard]] static std::size_t before(std::size_t i, std::size_t steps) {
    return i < steps ? 0 : i - steps;
  }
  [[nodiscard]] std::size_t after(std::size_t i, std::size_t steps) const {
    return std::min(i + steps, size() - 1);
  }
  [[nodiscard]] bool stands(std::size_t i) const {
    const double slow_m_per_s = std::min(kStands_m_per_s, kShareOfPeak * peak_m_per_s_);
    return peak_m_per_s_ < kTrembles_m_per_s || std::fabs(speed_m_per_s_[i]) <= slow_m_per_s;
  }
  [[nodiscard]] bool driven(std::size_t i) const {
    return std::any_of(driven_.begin() + static_cast<std::ptrdiff_t>(before(i, kForDrive)),
                       driven_.begin() + static_cast<std::ptrdiff_t>(after(i, kForDrive)) + 1,
                       [](bool one) { return one; });
  }
  // Slow, and on both sides in motion, in opposite directions.
  [[nodiscard]] bool turns(std::size_t i) const {
    const auto from = before(i, kForChange);
    const auto to = after(i, kForChange);
    const bool slow = std::fabs(speed_m_per_s_[i]) < std::fabs(speed_m_per_s_[from]) &&
                      std::fabs(speed_m_per_s_[i]) < std::fabs(speed_m_per_s_[to]);
    return slow && !stands(from) && !stands(to) && speed_m_per_s_[from] * speed_m_per_s_[to] < 0;
  }

  std::vector<Nanoseconds> time_ns_;
  std::vector<double> place_m_;
  std::vector<bool> driven_;
  std::vector<double> speed_m_per_s_;
  double peak_m_per_s_ = 0;
};

// What is shorter than anything that a motion does belongs to what was before.
std::vector<PhaseSpan> without_short_ones(const std::vector<PhaseSpan>& spans) {
  std::vector<PhaseSpan> kept;
  for (const auto& span : spans) {
    const bool joins = !kept.empty() && (span.to_ns - span.from_ns < kShortest_ns ||
                                         kept.back().phase == span.phase);
    if (joins) {
      kept.back().to_ns = span.to_ns;
    } else {
      kept.push_back(span);
    }
  }
  return kept;
}

bool moves(const PhaseSpan& span) {
  return span.phase != "rest" && span.phase != "hold";
}

}  // namespace

std::vector<PhaseSpan> phases_of_truth(const CaseRecord& run, core::Axis axis) {
  const Motion motion(run, axis);
  std::vector<PhaseSpan> spans;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto phase = motion.phase(i);
    if (!spans.empty()) {
      spans.back().to_ns = motion.time_ns(i);
    }
    if (spans.empty() || spans.back().phase != phase) {
      spans.push_back({phase, motion.time_ns(i), motion.time_ns(i)});
    }
  }
  return without_short_ones(spans);
}

std::optional<Travel> travel_of(const CaseRecord& run, core::Axis axis) {
  const auto spans = phases_of_truth(run, axis);
  const auto first = std::find_if(spans.begin(), spans.end(), moves);
  const auto last = std::find_if(spans.rbegin(), spans.rend(), moves);
  return first == spans.end() ? std::nullopt : std::optional<Travel>({first->from_ns, last->to_ns});
}

core::Axis first_to_travel(const CaseRecord& run) {
  auto first = core::kFirstAxis;
  std::optional<Nanoseconds> from_ns;
  for (const auto axis : core::kAllAxes) {
    const auto travel = travel_of(run, axis);
    if (travel && (!from_ns || travel->from_ns < *from_ns)) {
      first = axis;
      from_ns = travel->from_ns;
    }
  }
  return first;
}

}  // namespace towbench::harness
