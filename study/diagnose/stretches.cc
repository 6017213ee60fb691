#include "study/diagnose/stretches.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {

using Eigen::Index;
using Eigen::VectorXd;

double rms_said(const Eigen::Ref<const VectorXd>& e) {
  const auto said = static_cast<double>((e.array() != 0).count());
  return e.norm() / std::sqrt(std::max(1.0, said));
}

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
      of_run.push_back(rms_said(
          search.final.fitted.e.segment(data.starts[run] + from, std::min(each, n - from))));
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
  VectorXd in = VectorXd::Zero(e.size());
  for (const Stretch& s : stretches) {
    const Index from = data.starts[s.run] + s.from;
    in.segment(from, s.to - s.from) = e.segment(from, s.to - s.from);
  }
  const double to_N = model.parameters[Key::kMass] * search.bandwidth * search.bandwidth;
  aside.rms_N.push_back(to_N * rms_said(in));
  aside.others_rms_N = to_N * rms_said(search.final.fitted.e);
  return aside;
}

}  // namespace towbench::study::diagnose
