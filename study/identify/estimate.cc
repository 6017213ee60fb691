#include "study/identify/estimate.h"

#include <fstream>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "study/statistics/statistics.h"

namespace towbench::study::identify {
namespace {

constexpr const char* kSchema = "towbench/estimates/1";

}  // namespace

const Estimate* find(const Estimates& estimates, std::string_view quantity,
                     std::string_view axis) noexcept {
  const Estimate* found = nullptr;
  for (const auto& each : estimates) {
    if (each.quantity == quantity && each.axis == axis && !each.at) {
      found = &each;
    }
  }
  return found;
}

Estimate with_standard_error(Estimate estimate, double standard_error) {
  estimate.low = estimate.value - statistics::kNormal95 * standard_error;
  estimate.high = estimate.value + statistics::kNormal95 * standard_error;
  return estimate;
}

Estimate withheld(Estimate estimate, std::string reason) {
  estimate.low = estimate.value;
  estimate.high = estimate.value;
  estimate.no_interval = std::move(reason);
  return estimate;
}

nlohmann::json to_json(const Estimates& estimates) {
  auto list = nlohmann::json::array();
  for (const auto& each : estimates) {
    nlohmann::json one{{"quantity", each.quantity},  {"axis", each.axis},
                       {"value", each.value},        {"ci95", {each.low, each.high}},
                       {"unit", each.unit},          {"rests_on", each.rests_on},
                       {"procedure", each.procedure}};
    if (!each.no_interval.empty()) {
      one["ci95"] = nullptr;
      one["no_interval"] = each.no_interval;
    }
    if (each.at) {
      one["at"] = *each.at;
    }
    list.push_back(std::move(one));
  }
  return {{"schema", kSchema}, {"estimates", std::move(list)}};
}

Estimates estimates_from_json(const nlohmann::json& json) {
  Estimates estimates;
  for (const auto& one : json.at("estimates")) {
    Estimate each;
    one.at("quantity").get_to(each.quantity);
    one.at("axis").get_to(each.axis);
    one.at("value").get_to(each.value);
    each.no_interval = one.value("no_interval", "");
    const bool has_interval = each.no_interval.empty();
    each.low = has_interval ? one.at("ci95").at(0).get<double>() : each.value;
    each.high = has_interval ? one.at("ci95").at(1).get<double>() : each.value;
    one.at("unit").get_to(each.unit);
    one.at("rests_on").get_to(each.rests_on);
    one.at("procedure").get_to(each.procedure);
    if (one.contains("at")) {
      each.at = one.at("at").get<double>();
    }
    estimates.push_back(std::move(each));
  }
  return estimates;
}

void write_estimates(const std::filesystem::path& path, const Estimates& estimates) {
  auto half = path;
  half += ".part";
  std::ofstream stream(half);
  stream << to_json(estimates).dump(1) << '\n';
  if (!stream.flush()) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
  stream.close();
  std::filesystem::rename(half, path);
}

}  // namespace towbench::study::identify
