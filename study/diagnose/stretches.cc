#include "study/diagnose/stretches.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Squares {
  double sum = 0;
  double said = 0;  // samples

  void add(const Eigen::Ref<const VectorXd>& e) {
    sum += e.squaredNorm();
    said += static_cast<double>((e.array() != 0).count());
  }
  [[nodiscard]] double rms() const { return std::sqrt(sum / std::max(1.0, said)); }
};

}  // namespace

Index samples_of_window(const Run& run) noexcept {
  return std::max<Index>(1, std::lround(kStretchWindow_s / run.period_s));
}

std::vector<std::vector<double>> windows_m(const Data& data, const Search& search) {
  std::vector<std::vector<double>> out;
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    const Index n = data.starts[run + 1] - data.starts[run];
    const Index each = samples_of_window(*data.scenes[run].run);
    std::vector<double>& of_run = out.emplace_back();
    for (Index from = 0; from < n; from += each) {
      Squares s;
      s.add(search.final.fitted.e.segment(data.starts[run] + from, std::min(each, n - from)));
      of_run.push_back(s.rms());
    }
  }
  return out;
}

void leave_out(const std::vector<Stretch>& stretches, std::vector<Run>& runs) {
  for (const Stretch& s : stretches) {
    Run& run = runs[s.run];
    run.missing.resize(static_cast<std::size_t>(run.size()), 0);
    std::fill(run.missing.begin() + s.from, run.missing.begin() + s.to, 1);
  }
}

Aside score_stretches(const std::vector<Stretch>& stretches, const std::vector<Run>& runs,
                      const Search& search) {
  Aside aside;
  if (stretches.empty()) return aside;
  const Model& model = search.final.fitted.model;
  const Data data = make_data(runs, search.context.stated);
  const VectorXd e = innovations(data, model, search.bandwidth);
  Squares in;
  for (const Stretch& s : stretches) in.add(e.segment(data.starts[s.run] + s.from, s.to - s.from));
  Squares rest;
  rest.add(search.final.fitted.e);
  const double to_N = model.parameters[Key::kMass] * search.bandwidth * search.bandwidth;
  aside.rms_N.push_back(to_N * in.rms());
  aside.others_rms_N = to_N * rest.rms();
  return aside;
}

}  // namespace towbench::study::diagnose
