#include "study/diagnose/unlike_runs.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/diagnose/aside.h"

namespace towbench::study::diagnose {
namespace {

// Times the innovations of the run in the middle, of the worst.
constexpr double kApart = 1.5;  // where the motion tells much of what is left
constexpr double kFarOff = 10;  // where nothing is unexplained

std::vector<std::size_t> worst_first(const std::vector<double>& rms_m) {
  std::vector<std::size_t> order(rms_m.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rms_m[a] > rms_m[b]; });
  return order;
}

// It takes on what moves the axis in one run.
bool is_of_time(const NamedCause& cause) {
  const auto& scales = cause.effect->scales;
  return !scales.empty() && scales.front() == Key::kPeriodicHertz;
}

// Whether the others are asked by themselves.
bool may_be_unlike(const Diagnosis& all, const std::vector<std::size_t>& order) {
  if (is_fatal(all.findings) || order.size() < 2) return false;
  const std::vector<double>& rms_m = all.innovations_of_run_m;
  const double apart = rms_m[order[0]] / std::max(1e-300, rms_m[order[order.size() / 2]]);
  if (follows_the_motion(all)) return apart > kApart;
  return all.unexplained || std::any_of(all.causes.begin(), all.causes.end(), is_of_time) ||
         apart > kFarOff;
}

// The worst run; that of the stated model, where a fit that one run has led astray is worse in
// another; and the two worst where half of all stay.
std::vector<std::vector<std::size_t>> left_out_by_turns(const Diagnosis& all,
                                                        const std::vector<std::size_t>& order) {
  std::vector<std::vector<std::size_t>> out{{order[0]}};
  if (!all.stated_of_run_m.empty()) {
    const std::size_t by_the_stated = worst_first(all.stated_of_run_m).front();
    if (by_the_stated != order[0]) out.push_back({by_the_stated});
  }
  if (order.size() >= 4) out.push_back({order[0], order[1]});
  return out;
}

Request with_aside(const Request& all, const std::vector<std::size_t>& which) {
  Request out = all;
  out.runs.clear();
  for (std::size_t run = 0; run < all.runs.size(); ++run) {
    const bool aside = std::find(which.begin(), which.end(), run) != which.end();
    (aside ? out.aside : out.runs).push_back(all.runs[run]);
  }
  return out;
}

std::string names_of(const std::vector<Run>& runs) {
  std::vector<std::string> names;
  for (const Run& run : runs) names.push_back(run.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

}  // namespace

std::optional<Diagnosis> without_unlike_runs(const Request& request, const Diagnosis& all,
                                             Diagnosis (*diagnose_all)(const Request&)) {
  const std::vector<std::size_t> order = worst_first(all.innovations_of_run_m);
  if (!may_be_unlike(all, order)) return std::nullopt;
  for (const std::vector<std::size_t>& worst : left_out_by_turns(all, order)) {
    const Request part = with_aside(request, worst);
    Diagnosis others = diagnose_all(part);
    if (!explains_the_rest(others, all)) continue;
    for (const Run& run : part.aside) {
      others.findings.push_back(
          {logs::Finding::Kind::kNote, "run_left_out",
           run.name + " is left out: something moves the axis there that the log does not have"});
    }
    tell_of_aside(names_of(part.aside), all, others);
    others.left_out = worst;
    return others;
  }
  return std::nullopt;
}

}  // namespace towbench::study::diagnose
