#include "tests/study/diagnose/foreign/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace towbench::tests::foreign {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool says(const Named& cause, const Key& key) {
  return cause.names.size() <= kMostNames &&
         std::any_of(cause.names.begin(), cause.names.end(),
                     [&](const std::string& name) { return holds(key.right, name); });
}

// 95 % of a share (Wilson 1927).
std::pair<double, double> interval_pct(int hits, int all) {
  const double n = all;
  const double p = hits / n;
  constexpr double z = 1.96;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {100 * std::max(0.0, middle - half), 100 * std::min(1.0, middle + half)};
}

std::string reliability(const std::vector<Said>& all) {
  std::string out =
      "\n| p-value of what is named | named | wrong | wrong, % [95 %] |\n|---|---|---|---|\n";
  constexpr std::array kEdges{1.0, 1e-6, 1e-12, 1e-30, 1e-100, 0.0};
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i) {
    int named = 0;
    int wrong = 0;
    for (const Said& said : all) {
      if (said.p_value < kEdges[i] && said.p_value >= kEdges[i + 1]) {
        ++named;
        wrong += said.wrong ? 1 : 0;
      }
    }
    if (named == 0) continue;
    const auto [low, high] = interval_pct(wrong, named);
    out += fmt::format("| {:g} to {:g} | {} | {} | {:.0f} [{:.0f}, {:.0f}] |\n", kEdges[i + 1],
                       kEdges[i], named, wrong, 100.0 * wrong / named, low, high);
  }
  return out;
}

}  // namespace

Judged judge(const std::vector<Key>& hidden, bool is_outside, const Answer& answer) {
  Judged judged;
  if (!answer.refusal.empty()) {
    judged.outcome = Outcome::kRefused;
    return judged;
  }
  std::size_t found = 0;
  for (const Key& key : hidden) {
    found += std::any_of(answer.causes.begin(), answer.causes.end(),
                         [&](const Named& cause) { return says(cause, key); });
  }
  for (const Named& cause : answer.causes) {
    const bool explained = std::any_of(hidden.begin(), hidden.end(), [&](const Key& key) {
      return says(cause, key) || holds(key.beside, cause.names.front());
    });
    judged.said.push_back({cause.p_value, !explained});
    if (!explained) {
      judged.false_names.push_back(cause.names.front());
    }
  }
  const bool all = is_outside ? answer.unexplained : found == hidden.size();
  if (!judged.false_names.empty()) {
    judged.outcome = all && !hidden.empty() && !is_outside ? Outcome::kExtra : Outcome::kFalse;
  } else if (all) {
    judged.outcome = Outcome::kRight;
  } else {
    judged.outcome = found > 0 ? Outcome::kPartly : Outcome::kMissed;
  }
  return judged;
}

void Tally::add(const std::string& table, const std::string& row, const Judged& judged,
                bool is_unexplained) {
  Row& counted = tables_[table][row];
  ++counted.counts[static_cast<std::size_t>(judged.outcome)];
  ++counted.all;
  counted.unexplained += is_unexplained ? 1 : 0;
  for (const std::string& name : judged.false_names) {
    ++counted.false_names[name];
  }
}

void Tally::add(const std::vector<Said>& said) {
  said_.insert(said_.end(), said.begin(), said.end());
}

std::string Tally::words() const {
  std::string out = reliability(said_);
  for (const auto& [table, rows] : tables_) {
    out += fmt::format("\n| {} | cases |", table);
    for (const char* name : kOutcomes) out += fmt::format(" {} |", name);
    out += " right, % [95 %] | unexplained | false names |\n|---|---|";
    for (std::size_t i = 0; i < kOutcomes.size(); ++i) out += "---|";
    out += "---|---|---|\n";
    for (const auto& [name, row] : rows) {
      out += fmt::format("| {} | {} |", name, row.all);
      for (const int count : row.counts) out += fmt::format(" {} |", count);
      const int right = row.counts[static_cast<std::size_t>(Outcome::kRight)];
      const auto [low, high] = interval_pct(right, row.all);
      out += fmt::format(" {:.0f} [{:.0f}, {:.0f}] | {} |", 100.0 * right / row.all, low, high,
                         row.unexplained);
      for (const auto& [wrong, count] : row.false_names) {
        out += fmt::format(" {} x{}", wrong, count);
      }
      out += " |\n";
    }
  }
  return out;
}

}  // namespace towbench::tests::foreign
