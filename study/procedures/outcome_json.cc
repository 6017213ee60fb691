#include "study/procedures/outcome_json.h"

#include <array>
#include <cmath>
#include <limits>

namespace towbench::study::procedures {
namespace {

constexpr std::array<const char*, 3> kStatusNames{"done", "refused", "failed"};

// JSON has no NaN; null stands for it.
nlohmann::json numbers(const std::vector<double>& values) {
  auto list = nlohmann::json::array();
  for (const double value : values) {
    list.push_back(std::isfinite(value) ? nlohmann::json(value) : nlohmann::json());
  }
  return list;
}

std::vector<double> numbers_from(const nlohmann::json& json) {
  std::vector<double> values;
  for (const auto& each : json) {
    values.push_back(each.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                    : each.get<double>());
  }
  return values;
}

nlohmann::json of_figure(const Figure& figure) {
  auto curves = nlohmann::json::array();
  for (const auto& curve : figure.curves) {
    curves.push_back({{"name", curve.name},
                      {"dots", curve.mark == Mark::kDots},
                      {"x", numbers(curve.x)},
                      {"y", numbers(curve.y)},
                      {"low", numbers(curve.low)},
                      {"high", numbers(curve.high)}});
  }
  return {{"title", figure.title},
          {"x_label", figure.x_label},
          {"y_label", figure.y_label},
          {"caption", figure.caption},
          {"curves", std::move(curves)}};
}

Figure figure_from(const nlohmann::json& json) {
  Figure figure{.title = json.at("title"),
                .x_label = json.at("x_label"),
                .y_label = json.at("y_label"),
                .curves = {},
                .caption = json.at("caption")};
  for (const auto& curve : json.at("curves")) {
    figure.curves.push_back({.name = curve.at("name"),
                             .x = numbers_from(curve.at("x")),
                             .y = numbers_from(curve.at("y")),
                             .mark = curve.at("dots").get<bool>() ? Mark::kDots : Mark::kLine,
                             .low = numbers_from(curve.at("low")),
                             .high = numbers_from(curve.at("high"))});
  }
  return figure;
}

}  // namespace

nlohmann::json to_json(const ProcedureOutcome& outcome) {
  auto tables = nlohmann::json::array();
  for (const auto& table : outcome.tables) {
    tables.push_back({{"title", table.title}, {"head", table.head}, {"rows", table.rows}});
  }
  auto figures = nlohmann::json::array();
  for (const auto& figure : outcome.figures) {
    figures.push_back(of_figure(figure));
  }
  return {{"status", kStatusNames[static_cast<std::size_t>(outcome.status)]},
          {"reason", outcome.reason},
          {"simulated_s", outcome.simulated_s},
          {"estimates", identify::to_json(outcome.estimates)},
          {"withheld", identify::to_json(outcome.withheld)},
          {"tables", std::move(tables)},
          {"figures", std::move(figures)}};
}

ProcedureOutcome outcome_from_json(const nlohmann::json& json) {
  ProcedureOutcome outcome;
  const auto status = json.at("status").get<std::string>();
  for (std::size_t i = 0; i < kStatusNames.size(); ++i) {
    if (status == kStatusNames[i]) {
      outcome.status = static_cast<ProcedureOutcome::Status>(i);
    }
  }
  json.at("reason").get_to(outcome.reason);
  json.at("simulated_s").get_to(outcome.simulated_s);
  outcome.estimates = identify::estimates_from_json(json.at("estimates"));
  outcome.withheld = identify::estimates_from_json(json.at("withheld"));
  for (const auto& table : json.at("tables")) {
    outcome.tables.push_back(
        {.title = table.at("title"), .head = table.at("head"), .rows = table.at("rows")});
  }
  for (const auto& figure : json.at("figures")) {
    outcome.figures.push_back(figure_from(figure));
  }
  return outcome;
}

}  // namespace towbench::study::procedures
