#include "study/diagnose/shortlist.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace towbench::harness::diagnose {
namespace {

constexpr std::size_t kRefined = 6;  // of the best by the criterion

double information(const Candidate& c) {
  const double n = std::max(8.0, c.test.effective_samples);
  const auto parameters =
      static_cast<double>(c.term.effect->coefficients.size() + c.term.scales.size());
  return n * std::log(std::max(1e-12, 1 - c.test.explained)) + parameters * std::log(n);
}

void sort_by_information(std::vector<Candidate>& candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return information(a) < information(b); });
}

}  // namespace

Shortlist shortlist(Candidates& candidates, const Evidence& evidence,
                    const std::vector<Term>& taken, double least_N) {
  Shortlist list;
  list.all = candidates.best_of_each(evidence, taken);
  const auto speaks = [&](const Candidate& c) {
    const bool matters = c.test.projected_rms > least_N;
    return matters && c.plausible && c.test.left_of_group > kLeastLeft && c.p_value() < kAlpha;
  };
  std::copy_if(list.all.begin(), list.all.end(), std::back_inserter(list.best), speaks);
  sort_by_information(list.best);
  for (std::size_t i = 0; i < std::min(kRefined, list.best.size()); ++i) {
    list.best[i] = candidates.refined(evidence, list.best[i]);
  }
  std::erase_if(list.best, [&](const Candidate& c) { return !speaks(c); });
  sort_by_information(list.best);
  return list;
}

}  // namespace towbench::harness::diagnose
