// Innovations: what each measured position is off from where the model, corrected by all earlier
// ones, expected it.
//
//   e_k = y_k - h(x_k);  the state += correction(w) e_k
// A force that the model lacks appears in e behind a low pass of w: M w^2 e is that force in
// newtons (correction.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "study/prediction/axis.h"
#include "study/prediction/parameters.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {

// What is periodic, in the order of the keys of its phases.
inline constexpr int kWaves = 5;
inline constexpr std::array<Key, kWaves> kFrequencies{Key::kRipplePerMetre, Key::kPeriodicHertz,
                                                      Key::kOutOfRoundPerMetre, Key::kReadPerMetre,
                                                      Key::kWheelPerMetre};
// The place among them of a law that begins with this key; none: it is not periodic.
[[nodiscard]] constexpr std::optional<int> wave_of(Key first_scale) noexcept {
  for (int i = 0; i < kWaves; ++i) {
    if (kFrequencies[static_cast<std::size_t>(i)] == first_scale) return i;
  }
  return std::nullopt;
}

// What one run has of its own: its level of friction and its offset; and phases, because nobody
// knows how long the axis stood between two runs, or where its encoder began.
struct OfRun {
  double bias_N = 0;
  double coulomb_N = 0;
  std::array<double, kWaves> turns{};  // beside the first run's
};

struct Model {
  Parameters parameters;
  std::vector<OfRun> of_run;  // one a run

  [[nodiscard]] Parameters in_run(std::size_t run) const {
    Parameters p = parameters;
    p[Key::kBias] += of_run[run].bias_N;
    p[Key::kCoulomb] += of_run[run].coulomb_N;
    for (int i = 0; i < kWaves; ++i) {
      p[next(Key::kRippleTurns, i)] += of_run[run].turns[static_cast<std::size_t>(i)];
    }
    return p;
  }
};

// Runs that are predicted together, their samples one after the other.
struct Data {
  std::vector<Scene> scenes;
  std::vector<Eigen::Index> starts;  // of each run's samples, and the total

  [[nodiscard]] Eigen::Index samples() const noexcept { return starts.back(); }
};

// `runs` and `stated` outlive this.
[[nodiscard]] Data make_data(const std::vector<Run>& runs, const NominalModel& stated);

// Other runs of the same machine: shapes lie where they lay in `fitted`, and each run begins its
// own session where no clock tells when it began in theirs.
[[nodiscard]] Data make_data_like(const Data& fitted, const std::vector<Run>& runs,
                                  const NominalModel& stated);

// The innovations of one run, from its start on. In metres; zero where nothing can be said: until
// the start is forgotten and behind gaps.
// In cache lines of its own: other threads predict others at the same time.
class alignas(64) Innovations {
 public:
  Innovations(const Data& data, std::size_t run, const Parameters& parameters, double bandwidth);
  // Of the samples that follow, as many as `e` has places.
  void next(Eigen::Ref<Eigen::VectorXd> e);

 private:
  double at(Eigen::Index k);

  const Run& run_;
  double bandwidth_;
  Eigen::Index forgotten_;  // samples until a start is
  double farthest_m_;
  Correction correction_;
  Axis axis_;
  Eigen::Index next_ = 0;
  Eigen::Index silent_;
  Eigen::Index gap_ = 0;
  bool ran_away_ = false;
};

[[nodiscard]] Eigen::VectorXd innovations(const Data& data, const Model& model, double bandwidth);
// The same of one run alone.
[[nodiscard]] Eigen::VectorXd innovations_of(const Data& data, std::size_t run,
                                             const Parameters& parameters, double bandwidth);

}  // namespace towbench::study::diagnose
