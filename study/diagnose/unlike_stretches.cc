#include "study/diagnose/unlike_stretches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/diagnose/aside.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

constexpr double kFar = 3;            // times the median of all windows
constexpr double kVeryFar = 10;       // the same, where nothing is unexplained
constexpr std::size_t kBridged = 1;   // windows between two that are far off: a push turns over
constexpr std::size_t kShortest = 2;  // windows: a reversal is shorter
constexpr double kMostOfARun = 0.6;   // of its windows
constexpr int kRounds = 4;            // what is left out lets more be seen
constexpr double kCalmer = 0.95;      // of the median before, of a model that is better

// Of each run, which of its windows are put aside.
using Marks = std::vector<std::vector<bool>>;

double median_of(const std::vector<std::vector<double>>& windows) {
  std::vector<double> all;
  for (const auto& run : windows) {
    std::copy_if(run.begin(), run.end(), std::back_inserter(all), [](double w) { return w > 0; });
  }
  if (all.empty()) return 0;
  const auto middle = all.begin() + std::ssize(all) / 2;
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

// Those above `most`, where several follow each other, with one on either side.
std::vector<bool> far_off(const std::vector<double>& windows, double most) {
  std::vector<bool> marks(windows.size());
  const auto is_far = [&](std::size_t i) { return i < windows.size() && windows[i] > most; };
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (!is_far(i)) continue;
    std::size_t end = i + 1;
    for (std::size_t j = end; j <= end + kBridged; ++j) {
      if (is_far(j)) end = j + 1;
    }
    if (end - i >= kShortest) {
      const std::size_t from = i - std::min<std::size_t>(1, i);
      std::fill(marks.begin() + static_cast<std::ptrdiff_t>(from),
                marks.begin() + static_cast<std::ptrdiff_t>(std::min(end + 1, marks.size())), true);
    }
    i = end - 1;
  }
  return marks;
}

// Whether there are new ones.
bool mark(const Diagnosis& d, double far, Marks& marks) {
  const double usual = median_of(d.windows_m);
  if (usual <= 0) return false;
  bool some = false;
  for (std::size_t run = 0; run < d.windows_m.size(); ++run) {
    std::vector<bool> both = far_off(d.windows_m[run], far * usual);
    marks[run].resize(both.size());
    std::transform(both.begin(), both.end(), marks[run].begin(), both.begin(), std::logical_or<>());
    const auto count = static_cast<double>(std::count(both.begin(), both.end(), true));
    if (both == marks[run] || count > kMostOfARun * static_cast<double>(both.size())) continue;
    marks[run] = both;
    some = true;
  }
  return some;
}

std::vector<Stretch> stretches_of(const Marks& marks, const std::vector<Run>& runs) {
  std::vector<Stretch> out;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const Index each = samples_of_window(runs[run]);
    bool goes_on = false;
    for (std::size_t i = 0; i < marks[run].size(); ++i) {
      const Index from = static_cast<Index>(i) * each;
      if (marks[run][i] && !goes_on) out.push_back({run, from, from});
      if (marks[run][i]) out.back().to = std::min(from + each, runs[run].size());
      goes_on = marks[run][i];
    }
  }
  return out;
}

// Of each run that has some, as in the answer.
std::vector<std::string> words_of(const Request& part) {
  std::map<std::size_t, std::vector<std::string>> of_run;
  for (const Stretch& s : part.stretches) {
    const double period_s = part.runs[s.run].period_s;
    of_run[s.run].push_back(fmt::format("{:.2f} to {:.2f} s",
                                        static_cast<double>(s.from) * period_s,
                                        static_cast<double>(s.to) * period_s));
  }
  std::vector<std::string> out;
  for (const auto& [run, when] : of_run) {
    out.push_back(fmt::format("{}: {}", part.runs[run].name, fmt::join(when, ", ")));
  }
  return out;
}

}  // namespace

std::optional<Diagnosis> without_unlike_stretches(const Request& request, const Diagnosis& all,
                                                  Diagnosis (*diagnose_all)(const Request&)) {
  if (is_fatal(all.findings)) return std::nullopt;
  if (follows_the_motion(all)) return std::nullopt;
  Marks marks(request.runs.size());
  if (!all.unexplained && !mark(all, kVeryFar, marks)) return std::nullopt;
  marks.assign(request.runs.size(), {});
  Request part = request;
  Diagnosis rest = all;
  double usual = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const double now = median_of(rest.windows_m);
    if (now > kCalmer * usual || !mark(rest, kFar, marks)) break;
    usual = now;
    part.stretches = stretches_of(marks, request.runs);
    rest = diagnose_all(part);
    if (is_fatal(rest.findings) || !are_unlike(rest, kUnlike)) return std::nullopt;
    if (follows_the_motion(rest)) return std::nullopt;
  }
  if (part.stretches.empty() || !explains_the_rest(rest, all)) return std::nullopt;
  const std::vector<std::string> words = words_of(part);
  for (const std::string& when : words) {
    rest.findings.push_back(
        {logs::Finding::Kind::kNote, "stretch_left_out",
         when + " is left out: something moves the axis there that the log does not have"});
  }
  rest.stretches = part.stretches;
  tell_of_aside(fmt::format("{}", fmt::join(words, "; ")), all, rest);
  return rest;
}

}  // namespace towbench::study::diagnose
