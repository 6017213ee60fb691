#include "study/diagnose/unlike_runs.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/diagnose/aside.h"

namespace towbench::study::diagnose {
namespace {

// The innovations of the worst run, over those of the run in the middle.
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

// How many times the worst is the one in the middle.
double apart(const std::vector<double>& rms_m) {
  const std::vector<std::size_t> order = worst_first(rms_m);
  return rms_m[order[0]] / std::max(1e-300, rms_m[order[order.size() / 2]]);
}

// Whether the others are asked by themselves.
bool may_be_unlike(const Diagnosis& all) {
  const std::vector<double>& rms_m = all.innovations_of_run_m;
  if (is_fatal(all.findings) || rms_m.size() < 2) return false;
  if (follows_the_motion(all)) return apart(rms_m) > kApart;
  return all.unexplained || std::any_of(all.causes.begin(), all.causes.end(), is_of_time) ||
         apart(rms_m) > kFarOff;
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

// The run that is predicted worst among those that are not left out, if no cause is named there and
// that run is apart: another push may hide a cause.
std::optional<std::size_t> next_apart(const Diagnosis& others, std::size_t runs,
                                      const std::vector<std::size_t>& left_out) {
  const std::vector<double>& rms_m = others.innovations_of_run_m;
  const bool half_stay = 2 * (left_out.size() + 1) <= runs;
  if (!others.causes.empty() || !half_stay || apart(rms_m) <= kApart) return std::nullopt;
  std::size_t next = worst_first(rms_m).front();
  std::vector<std::size_t> before = left_out;
  std::sort(before.begin(), before.end());
  for (const std::size_t run : before) next += run <= next ? 1 : 0;
  return next;
}

std::string names_of(const std::vector<Run>& runs) {
  std::vector<std::string> names;
  for (const Run& run : runs) names.push_back(run.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

void tell_of(const std::vector<Run>& left_out, const Diagnosis& all, Diagnosis& others) {
  for (const Run& run : left_out) {
    others.findings.push_back(
        {logs::Finding::Kind::kNote, "run_left_out",
         run.name + " is left out: something moves the axis there that the log does not have"});
  }
  tell_of_aside(names_of(left_out), all, others);
}

}  // namespace

std::optional<Diagnosis> without_unlike_runs(const Request& request, const Diagnosis& all,
                                             Diagnosis (*diagnose_all)(const Request&)) {
  if (!may_be_unlike(all)) return std::nullopt;
  const auto without = [&](const std::vector<std::size_t>& left_out) -> std::optional<Diagnosis> {
    Diagnosis others = diagnose_all(with_aside(request, left_out));
    if (!explains_the_rest(others, all)) return std::nullopt;
    others.left_out = left_out;
    return others;
  };
  for (std::vector<std::size_t> worst :
       left_out_by_turns(all, worst_first(all.innovations_of_run_m))) {
    std::optional<Diagnosis> others = without(worst);
    if (!others) continue;
    if (const auto next = next_apart(*others, request.runs.size(), worst)) {
      worst.push_back(*next);
      auto fewer = without(worst);
      if (fewer && !fewer->causes.empty()) others = std::move(fewer);
    }
    tell_of(with_aside(request, others->left_out).aside, all, *others);
    return others;
  }
  return std::nullopt;
}

}  // namespace towbench::study::diagnose
