#include "study/results/kept_tow.h"

#include "study/procedures/outcome_json.h"

namespace towbench::study {
namespace {

nlohmann::json stretches(const std::vector<identify::TowStretch>& list) {
  auto json = nlohmann::json::array();
  for (const auto& each : list) {
    json.push_back({each.speed_m_per_s, each.from_m, each.to_m});
  }
  return json;
}

std::vector<identify::TowStretch> stretches_from(const nlohmann::json& json) {
  std::vector<identify::TowStretch> list;
  for (const auto& each : json) {
    list.push_back({.speed_m_per_s = each.at(0), .from_m = each.at(1), .to_m = each.at(2)});
  }
  return list;
}

}  // namespace

nlohmann::json tow_to_json(const procedures::TowOutcome& outcome) {
  auto json = procedures::to_json(outcome);
  json["blind"] = nlohmann::json::array();
  for (const auto& each : outcome.blind) {
    json["blind"].push_back({{"quantity", each.quantity},
                             {"identified", stretches(each.identified)},
                             {"towed", stretches(each.towed)}});
  }
  return json;
}

procedures::TowOutcome tow_from_json(const nlohmann::json& json) {
  procedures::TowOutcome outcome;
  static_cast<procedures::ProcedureOutcome&>(outcome) = procedures::outcome_from_json(json);
  for (const auto& each : json.at("blind")) {
    outcome.blind.push_back({.quantity = each.at("quantity"),
                             .identified = stretches_from(each.at("identified")),
                             .towed = stretches_from(each.at("towed"))});
  }
  return outcome;
}

}  // namespace towbench::study
