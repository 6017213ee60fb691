#include "harness/campaign/campaign_report.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>

#include "harness/fault_plan/fault.h"
#include "harness/fault_plan/fault_syntax.h"

namespace towbench::harness {
namespace {

using nlohmann::json;
using Results = std::vector<json>;

void count(CampaignSummary& into, const json& line) {
  ++into.cases;
  into.fired += line.value("fired", false) ? 1U : 0U;
  into.detected += line.value("detected", false) ? 1U : 0U;
  into.handled += line.value("handled", false) ? 1U : 0U;
  into.failed += line.value("verdict", "") == "FAIL" ? 1U : 0U;
  into.invalid += line.value("verdict", "") == "INVALID" ? 1U : 0U;
}

std::string row_of(const std::string& name, const CampaignSummary& sum) {
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, sum.cases, sum.fired,
                     sum.detected, sum.handled, sum.failed, sum.invalid);
}

std::string matrix(const Results& results, const char* first, const char* second) {
  std::map<std::string, CampaignSummary> rows;
  for (const auto& line : results) {
    auto name = line.contains(first) && line.at(first).is_number()
                    ? std::to_string(line.at(first).get<std::size_t>())
                    : line.value(first, "");
    name += second == nullptr ? "" : ' ' + line.value(second, "");
    count(rows[name], line);
  }
  std::string text =
      "| | injected | fired | detected | handled | failed | invalid |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const auto& [name, sum] : rows) {
    text += row_of(name, sum);
  }
  return text + row_of("**all**", summary_of(results));
}

struct Figure {
  const char* key;
  const char* meaning;
  const char* unit;
  double scale;
};
constexpr std::array<Figure, 8> kFigures{{
    {"kill_to_zero_duty_s", "kill switch's edge to zero duty", "ms", 1e3},
    {"end_stop_to_reaction_s", "end-stop's edge to the reaction", "ms", 1e3},
    {"to_fault_s", "cause to latched fault", "ms", 1e3},
    {"to_zero_drive_s", "cause to zero drive", "ms", 1e3},
    {"to_zero_drive_m", "cause to zero drive", "mm", 1e3},
    {"to_standstill_s", "cause to standstill", "ms", 1e3},
    {"to_standstill_m", "cause to standstill", "mm", 1e3},
    {"contact_speed_m_per_s", "speed at a hard end", "mm/s", 1e3},
}};

// The case's name, as a link where its run folder was kept.
std::string linked(const CampaignReport& report, const std::string& name) {
  const auto kept = report.kept.find(name);
  return kept == report.kept.end() ? '`' + name + '`'
                                   : fmt::format("[`{}`]({})", name, kept->second);
}

std::string figures(const CampaignReport& report, const Results& results) {
  std::string text =
      "| figure | cases | median | 90 % | 99 % | worst | case |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (const auto& figure : kFigures) {
    std::vector<std::pair<double, std::string>> values;
    for (const auto& line : results) {
      if (line.contains(figure.key)) {
        values.emplace_back(figure.scale * line.at(figure.key).get<double>(),
                            line.value("case", ""));
      }
    }
    if (values.empty()) {
      continue;
    }
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double share) {
      const auto last = static_cast<double>(values.size() - 1);
      return values[static_cast<std::size_t>(share * last + 0.5)].first;
    };
    text += fmt::format("| {} | {} | {:.3g} {} | {:.3g} | {:.3g} | {:.4g} | {} |\n", figure.meaning,
                        values.size(), quantile(0.5), figure.unit, quantile(0.9), quantile(0.99),
                        values.back().first, linked(report, values.back().second));
  }
  return text;
}

std::string rules(const Results& results) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> judged;  // applied, broken
  for (const auto& line : results) {
    for (const auto& rule : line.value("rules", json::array())) {
      ++judged[rule.get<std::string>()].first;
    }
    for (const auto& broken : line.value("broken", json::array())) {
      ++judged[broken.value("rule", "")].second;
    }
  }
  std::string text = "| requirement | judged in | broken in |\n| --- | ---: | ---: |\n";
  for (const auto& [name, counts] : judged) {
    text += fmt::format("| {} | {} | {} |\n", name, counts.first, counts.second);
  }
  return text;
}

// "TRK-5 (FR-2)" of "TRK-5 (FR-2): trapezoid, best law", "TRK-1" of "TRK-1", else nothing.
std::string requirement_of(const std::string& source) {
  const auto colon = source.find(':');
  const bool says_no_id = colon == std::string::npos && source.find(' ') != std::string::npos;
  return says_no_id ? std::string() : source.substr(0, colon);
}

// How far from the nominal machine which requirement gives way; empty where all are as far.
std::string spreads(const Results& results) {
  struct At {
    std::set<std::size_t> machines;
    CampaignSummary sum;
    std::map<std::string, std::size_t> broken;
  };
  std::map<double, At> at_spread;
  std::map<std::string, double> gives_way_at;
  for (const auto& line : results) {
    const double spread = line.value("spread", 0.0);
    auto& at = at_spread[spread];
    at.machines.insert(line.value("machine", std::size_t{0}));
    count(at.sum, line);
    std::set<std::string> of_case;
    for (const auto& broken : line.value("broken", json::array())) {
      const auto id = requirement_of(broken.value("source", ""));
      const auto rule = fmt::format("`{}`", broken.value("rule", ""));
      of_case.insert(id.empty() ? rule : id);
      const auto first =
          gives_way_at.try_emplace(id.empty() ? rule : id + ' ' + rule, spread).first;
      first->second = std::min(first->second, spread);
    }
    for (const auto& name : of_case) {
      ++at.broken[name];
    }
  }
  if (at_spread.size() < 3) {  // the nominal machine and one spread
    return {};
  }
  std::string text =
      "| spread | machines | cases | handled | failed | invalid | requirements broken, in cases |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (const auto& [spread, at] : at_spread) {
    std::string broken;
    for (const auto& [rule, cases] : at.broken) {
      broken += fmt::format("{}{} {}", broken.empty() ? "" : ", ", rule, cases);
    }
    text += fmt::format("| {:.0f} % | {} | {} | {} | {} | {} | {} |\n", 100 * spread,
                        at.machines.size(), at.sum.cases, at.sum.handled, at.sum.failed,
                        at.sum.invalid, broken.empty() ? "none" : broken);
  }
  std::vector<std::pair<double, std::string>> in_order;
  for (const auto& [name, spread] : gives_way_at) {
    in_order.emplace_back(spread, name);
  }
  std::sort(in_order.begin(), in_order.end());
  text += in_order.empty() ? "\nEvery requirement holds at every spread.\n" : "\n";
  for (std::size_t i = 0; i < in_order.size(); ++i) {
    text += fmt::format("{}. {} gives way at {:.0f} %\n", i + 1, in_order[i].second,
                        100 * in_order[i].first);
  }
  return text;
}

std::string complaints(const CampaignReport& report, const Results& results,
                       const std::string& verdict) {
  constexpr std::size_t kMost = 40;
  std::string text;
  std::size_t told = 0;
  for (const auto& line : results) {
    if (line.value("verdict", "") != verdict || ++told > kMost) {
      continue;
    }
    text += fmt::format("- {}: ", linked(report, line.value("case", "")));
    for (const auto& broken : line.value("broken", json::array())) {
      text += fmt::format("{}: {}; ", broken.value("rule", ""), broken.value("reason", ""));
    }
    text += fmt::format("again: `{}`\n", report.again(line));
  }
  return told > kMost ? text + fmt::format("- and {} more\n", told - kMost) : text;
}

// Every kind at every moment: how often it was tried there. A dash: never tried there.
std::string coverage(const Results& results) {
  std::map<std::string, std::map<std::string, std::size_t>> tried;
  std::set<std::string> moments(std::begin(kPhaseNames), std::end(kPhaseNames));
  for (const auto& row : fault_catalogue()) {
    if (!needs_a_fitted_part(row.needs)) {
      tried[fmt::format("{} {}", name_of(row.part), row.name)];
    }
  }
  for (const auto& line : results) {
    const auto place = place_named(line.value("part", ""));
    const auto part = place ? std::string(name_of(place->part)) : line.value("part", "");
    const auto moment = line.value("moment", "");
    ++tried[fmt::format("{} {}", part, line.value("kind", ""))][moment];
    moments.insert(moment);
  }
  std::string text = "| |";
  std::string rule = "| --- |";
  for (const auto& moment : moments) {
    text += fmt::format(" {} |", moment);
    rule += " ---: |";
  }
  text += '\n' + rule + '\n';
  for (const auto& [kind, at] : tried) {
    text += fmt::format("| {}{} |", kind, at.empty() ? " **not tried**" : "");
    for (const auto& moment : moments) {
      const auto found = at.find(moment);
      text += found == at.end() ? std::string(" - |") : fmt::format(" {} |", found->second);
    }
    text += '\n';
  }
  return text;
}

std::string remarks(const Results& results) {
  std::map<std::string, std::size_t> counted;
  for (const auto& line : results) {
    for (const auto& remark : line.value("remarks", json::array())) {
      ++counted[remark.get<std::string>()];
    }
  }
  std::string text;
  for (const auto& [remark, times] : counted) {
    text += fmt::format("- {} x {}\n", times, remark);
  }
  return text;
}

}  // namespace

std::vector<json> load_results(const std::filesystem::path& folder, const std::string& of) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const auto name = entry.path().filename().string();
      if (name.starts_with("results") && name.ends_with(".jsonl") && entry.is_regular_file()) {
        files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  std::map<std::string, json> by_case;
  for (const auto& file : files) {
    std::ifstream stream(file);
    std::string text;
    while (std::getline(stream, text)) {
      auto line = json::parse(text, nullptr, false);
      if (line.is_object() && line.contains("case") && line.value("of", "") == of) {
        by_case.try_emplace(line.at("case").get<std::string>(), std::move(line));
      }
    }
  }
  std::vector<json> results;
  for (auto& [id, line] : by_case) {
    results.push_back(std::move(line));
  }
  return results;
}

CampaignSummary summary_of(const Results& results) {
  CampaignSummary sum;
  for (const auto& line : results) {
    count(sum, line);
  }
  return sum;
}

std::map<std::string, json> worst_cases(const Results& results) {
  std::map<std::string, json> worst;
  for (const auto& figure : kFigures) {
    for (const auto& line : results) {
      if (line.contains(figure.key) &&
          (!worst.contains(figure.key) ||
           line.at(figure.key) >= worst.at(figure.key).at(figure.key))) {
        worst[figure.key] = line;
      }
    }
  }
  return worst;
}

std::string campaign_report(const CampaignReport& report, const Results& results) {
  const auto& sum = report.sum;
  auto text = fmt::format(
      "# {}\n\n{}: {} cases, {} fired, {} detected, {} handled, {} failed, {} "
      "invalid; {} not run yet\n\n",
      report.title.empty() ? "Campaign" : report.title, name_of(sum.verdict()), sum.cases,
      sum.fired, sum.detected, sum.handled, sum.failed, sum.invalid, sum.missing);
  if (!report.controller.empty()) {
    text += fmt::format("Controller: `{}`\n\n", report.controller);
  }
  text += fmt::format(
      "Injected: made to happen. Fired: a plant or sensor signal differs from the fault-free "
      "reference run. Detected: {}. Handled: every requirement that applies held; a fault that "
      "nobody can see is handled when nothing worse follows.\n\n",
      report.controller.empty() ? "the controller latched a fault"
                                : "the drive ended earlier than in that run");
  text += fmt::format(
      "Failed and worst cases link to the folder of their run. Any other case, by the name in "
      "`results*.jsonl`, is run again with `{}`, which prints the folder.\n\n",
      report.keep_command);
  text += "## Faults\n\n" + matrix(results, "part", "kind");
  text += "\n## Phases\n\n" + matrix(results, "moment", nullptr);
  text += "\n## Motions\n\n" + matrix(results, "motion", nullptr);
  text += "\n## Machines (0: nominal)\n\n" + matrix(results, "machine", nullptr);
  text += "\n## Carriers\n\n" + matrix(results, "carrier", nullptr);
  text += "\n## Requirements\n\n" + rules(results);
  text += "\n## Figures, and the case behind the worst\n\n" + figures(report, results);
  const auto section = [&](const char* head, const std::string& body) {
    text += body.empty() ? "" : fmt::format("\n## {}\n\n{}", head, body);
  };
  section("Spread of the drawn machines", spreads(results));
  section("Failed", complaints(report, results, "FAIL"));
  section("Invalid: took no effect, or proves nothing", complaints(report, results, "INVALID"));
  section("Passed with a remark", remarks(results));
  section("Covered: cases of each kind at each moment", coverage(results));
  std::string refused;
  for (const auto& kind : report.refused) {
    refused += "- " + kind + "\n";
  }
  section("Refused: what a carrier cannot have", refused);
  return text;
}

}  // namespace towbench::harness
