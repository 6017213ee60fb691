#include "study/diagnose/unlike_runs.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::study::diagnose {
namespace {

constexpr std::size_t kMostLeftOut = 2;
constexpr double kUnlike = 2;       // times what the others leave of the force
constexpr double kQuiteUnlike = 5;  // where something stays unexplained in them too
constexpr double kFarOff = 10;      // times the others' innovations, though nothing is unexplained

std::vector<std::size_t> worst_first(const std::vector<double>& rms_m) {
  std::vector<std::size_t> order(rms_m.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rms_m[a] > rms_m[b]; });
  return order;
}

// Whether the others are asked by themselves.
bool may_be_unlike(const Diagnosis& all, const std::vector<std::size_t>& order) {
  if (is_fatal(all.findings) || order.size() < 2) return false;
  const std::vector<double>& rms_m = all.innovations_of_run_m;
  return all.unexplained || rms_m[order[0]] > kFarOff * rms_m[order[order.size() / 2]];
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

bool has_free_shape(const Diagnosis& d) {
  return std::any_of(d.causes.begin(), d.causes.end(),
                     [](const NamedCause& cause) { return cause.effect->flexible; });
}

// Better than `all` does.
bool explains_the_others(const Diagnosis& others, const Diagnosis& all) {
  if (is_fatal(others.findings)) return false;
  if (others.causes.empty() && (others.unexplained || !all.causes.empty())) return false;
  if (has_free_shape(others)) return false;  // that takes on what is not its own
  const double unlike = others.unexplained ? kQuiteUnlike : kUnlike;
  const auto& aside_N = others.aside.rms_N;
  return *std::min_element(aside_N.begin(), aside_N.end()) > unlike * others.aside.others_rms_N;
}

// What is in the runs left out stays unexplained, beside what is in the others.
void tell_of_aside(const Request& request, const Diagnosis& all, Diagnosis& others) {
  std::vector<std::string> names;
  for (const Run& run : request.aside) {
    names.push_back(run.name);
    others.findings.push_back(
        {logs::Finding::Kind::kNote, "run_left_out",
         run.name + " is left out: something moves the axis there that the log does not have"});
  }
  if (others.unexplained) return;
  others.verdicts.emplace_back("unexplained_structure");
  const double most_N = *std::max_element(others.aside.rms_N.begin(), others.aside.rms_N.end());
  others.unexplained =
      Unexplained{.coordinate = fmt::format("time in {}", fmt::join(names, " and ")),
                  .share = 1 - others.aside.others_rms_N / most_N,
                  .rms_N = most_N,
                  .p_value = all.unexplained ? all.unexplained->p_value : 0};
  std::erase(others.verdicts, "model_adequate");
}

}  // namespace

std::optional<Diagnosis> without_unlike_runs(const Request& request, const Diagnosis& all,
                                             Diagnosis (*diagnose_all)(const Request&)) {
  const std::vector<std::size_t> order = worst_first(all.innovations_of_run_m);
  if (!may_be_unlike(all, order)) return std::nullopt;
  const std::size_t most = std::min(kMostLeftOut, request.runs.size() / 2);
  for (std::size_t count = 1; count <= most; ++count) {
    const std::vector<std::size_t> worst(order.begin(),
                                         order.begin() + static_cast<std::ptrdiff_t>(count));
    const Request part = with_aside(request, worst);
    Diagnosis others = diagnose_all(part);
    if (!explains_the_others(others, all)) continue;
    tell_of_aside(part, all, others);
    others.left_out = worst;
    return others;
  }
  return std::nullopt;
}

}  // namespace towbench::study::diagnose
