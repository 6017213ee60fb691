// One case of a campaign as one line of JSON: the same on every machine and in every order.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "harness/campaign/campaign.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/faults/fault_text.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

json identity_of(const Campaign& campaign, const CampaignCase& one) {
  return {{"case", one.id},         {"motion", one.motion},      {"part", one.part},
          {"kind", one.kind},       {"moment", one.moment},      {"faults", one.faults},
          {"machine", one.machine}, {"of", campaign.fingerprint}};
}

void put(json& line, const char* key, const std::optional<double>& value) {
  if (value) {
    line[key] = *value;
  }
}

}  // namespace

FaultPlan plan_of(const CampaignCase& one) {
  FaultPlan plan;
  for (const auto& words : one.faults) {
    plan.push_back(parse_fault(words));
  }
  return plan;
}

std::string run_campaign_case(const Campaign& campaign, const CampaignCase& one) {
  auto line = identity_of(campaign, one);
  try {
    const auto& motion = motion_of(campaign, one);
    const auto seed = motion.plain.experiment.seed;
    const auto prepared = prepare(plan_of(one), motion.plain, *motion.twin);
    const auto verdict = judge_case(motion.plain, prepared, *motion.twin, seed);
    const auto& figures = verdict.figures;
    line["verdict"] = name_of(verdict.verdict());
    line["fired"] = verdict.fired;
    line["detected"] = verdict.detected;
    line["handled"] = verdict.handled;
    line["latched"] = core::number_of(figures.fault);
    line["cause_s"] = core::seconds(figures.cause_ns);
    put(line, "to_fault_s", figures.to_fault_s);
    put(line, "to_zero_drive_s", figures.to_zero_drive_s);
    put(line, "to_zero_drive_m", figures.to_zero_drive_m);
    put(line, "to_standstill_s", figures.to_standstill_s);
    put(line, "to_standstill_m", figures.to_standstill_m);
    put(line, "kill_to_zero_duty_s", figures.kill_to_zero_duty_s);
    put(line, "end_stop_to_reaction_s", figures.end_stop_to_reaction_s);
    if (figures.contact_speed_m_per_s > 0) {
      line["contact_speed_m_per_s"] = figures.contact_speed_m_per_s;
    }
    auto rules = json::array();
    for (const auto& check : verdict.checks) {
      rules.push_back(check.name);
      if (check.verdict != Verdict::kPass) {
        line["broken"].push_back({{"rule", check.name}, {"reason", check.reason}});
      } else if (!check.reason.empty()) {
        line["remarks"].push_back(check.reason);
      }
    }
    line["rules"] = std::move(rules);
  } catch (const FixtureError& error) {
    line["verdict"] = name_of(Verdict::kInvalid);
    line["fired"] = line["detected"] = line["handled"] = false;
    line["broken"].push_back({{"rule", "fault_fired"}, {"reason", error.what()}});
  }
  return line.dump();
}

std::string crashed_case(const Campaign& campaign, const CampaignCase& one,
                         const std::string& how) {
  auto line = identity_of(campaign, one);
  line["verdict"] = name_of(Verdict::kFail);
  line["fired"] = true;
  line["detected"] = line["handled"] = false;
  line["broken"].push_back({{"rule", "no_crash"}, {"reason", how}});
  return line.dump();
}

}  // namespace towbench::harness
