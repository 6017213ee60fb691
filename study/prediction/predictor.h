// Innovations: what each measured position is off from where the model, corrected by all earlier
// ones, expected it.
//
//   e_k = y_k - h(x_k);  x_k += (1 - r^2) e_k,  v_k += (1 - r)^2 / T e_k,  r = exp(-w T)
// Both poles of the correction lie at w (fading memory; Ljung 1999, ch. 7). A force that the model
// lacks appears in e behind a low pass of w: M w^2 e is that force in newtons.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "study/prediction/axis.h"
#include "study/prediction/parameters.h"
#include "study/prediction/scene.h"

namespace towbench::study::diagnose {

// What one run has of its own: its level of friction and its offset.
struct OfRun {
  double bias_N = 0;
  double coulomb_N = 0;
};

struct Model {
  Parameters parameters;
  std::vector<OfRun> of_run;  // one a run

  [[nodiscard]] Parameters in_run(std::size_t run) const {
    Parameters p = parameters;
    p[Key::kBias] += of_run[run].bias_N;
    p[Key::kCoulomb] += of_run[run].coulomb_N;
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
// own session.
[[nodiscard]] Data make_data_like(const Data& fitted, const std::vector<Run>& runs,
                                  const NominalModel& stated);

// The innovations of one run, from its start on. In metres; zero where nothing can be said: until
// the start is forgotten and behind gaps.
class Innovations {
 public:
  Innovations(const Data& data, std::size_t run, const Parameters& parameters, double bandwidth);
  // Of the samples that follow, as many as `e` has places.
  void next(Eigen::Ref<Eigen::VectorXd> e);

 private:
  double at(Eigen::Index k);

  const Run& run_;
  double bandwidth_;
  double by_place_;
  double by_speed_;
  Eigen::Index forgotten_;  // samples until a start is
  double farthest_m_;
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
