#include "study/diagnose/own_values.h"

#include <limits>

#include "study/prediction/fit.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTurnsTried = 24;  // phases

// Of what is periodic, the phase at which the first part is predicted best.
void find_turns(const Data& data, std::size_t run, Model& model, double part, double bandwidth) {
  const auto first =
      static_cast<Index>(part * static_cast<double>(data.starts[run + 1] - data.starts[run]));
  for (const Key key : kFrequencies) {
    if (model.parameters[key] == 0) continue;
    double& turns = model.of_run[run].turns[static_cast<std::size_t>(*wave_of(key))];
    double best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTurnsTried; ++i) {
      turns = static_cast<double>(i) / kTurnsTried;
      VectorXd e(first);
      Innovations(data, run, model.in_run(run), bandwidth).next(e);
      if (e.squaredNorm() < least) {
        least = e.squaredNorm();
        best = turns;
      }
    }
    turns = best;
  }
}

}  // namespace

Model with_own_values(const Data& data, const Context& context, const Parameters& parameters,
                      double part, double bandwidth) {
  Model model{parameters, std::vector<OfRun>(data.scenes.size())};
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    find_turns(data, run, model, part, bandwidth);
    std::vector<FreeParameter> free;
    for (const FreeParameter& f : base_free_parameters(context, data.scenes.size() + 1)) {
      if (f.of != FreeParameter::Of::kAll && f.run == run) free.push_back(f);
    }
    const VectorXd e = innovations(data, model, bandwidth);
    MatrixXd all(data.samples(), std::ssize(free) + 1);
    all << columns_of(data, e, varied(model, free), bandwidth), e;
    const Index from = data.starts[run];
    const auto n = static_cast<double>(data.starts[run + 1] - from);
    const auto to = from + static_cast<Index>(part * n);
    const double square = e.segment(from, to - from).squaredNorm() / std::max(1.0, part * n);
    const Blocks blocks(all, {{from, to}}, ridge_of(free, context, square));
    const VectorXd by = blocks.fit({0, 1}).b;
    for (std::size_t j = 0; j < free.size(); ++j) {
      value_in(model, free[j]) += by[static_cast<Index>(j)];
    }
  }
  return model;
}

}  // namespace towbench::study::diagnose
