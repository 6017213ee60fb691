// One case of a campaign as one line of JSON: the same on every machine and in every order.
#include <algorithm>
#include <exception>
#include <optional>

#include <nlohmann/json.hpp>

#include "harness/campaign/campaign.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/external/conformance.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/record/temporary_folder.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

json identity_of(const Campaign& campaign, const CampaignCase& one) {
  return {{"case", one.id},         {"motion", one.motion},
          {"part", one.part},       {"kind", one.kind},
          {"moment", one.moment},   {"faults", one.faults},
          {"machine", one.machine}, {"spread", campaign.spread_of(one.machine)},
          {"carrier", one.carrier}, {"of", campaign.fingerprint}};
}

void put(json& line, const char* key, const std::optional<double>& value) {
  if (value) {
    line[key] = *value;
  }
}

// Into a folder that nobody keeps, from one process to another, judged with what was written.
CaseVerdict verdict_on_record(const Campaign& campaign, const CampaignMotion& motion,
                              const CampaignCase& one) {
  auto fixture = motion.plain;
  add_faults(fixture, plan_of(one));
  const TemporaryFolder folder;
  RunOptions options;
  options.out = folder.path();
  options.program = campaign.program;
  choose_carrier(one.carrier, options);
  auto run = run_experiment(fixture, options);
  if (run.faults) {
    return std::move(*run.faults);
  }
  CaseVerdict nothing;
  nothing.checks.push_back(run_not_complete(run.reason));
  return nothing;
}

// Without a fault there is nothing to set beside a reference run: the experiment's own budgets.
CaseVerdict verdict_by_budgets(const Campaign& campaign, const CampaignCase& one) {
  const TemporaryFolder folder;
  RunOptions options;
  options.out = folder.path();
  auto run = run_experiment(one.machine == 0 ? campaign.motion(one.motion).plain
                                             : campaign.drawn->plain(one.machine, one.motion),
                            options);
  CaseVerdict verdict;
  verdict.checks = std::move(run.judgement.checks);
  if (!run.complete) {
    verdict.checks.push_back(run_not_complete(run.reason));
  }
  verdict.fired = run.complete;  // nothing was to fire
  verdict.handled = verdict.verdict() == Verdict::kPass;
  return verdict;
}

CaseVerdict verdict_of_duty(const Campaign& campaign, const CampaignCase& one) {
  CaseVerdict verdict;
  verdict.checks =
      check_conformance(campaign.controller.external->command,
                        campaign.motions.front().plain.rig.parameters, "/dev/null", one.kind);
  verdict.fired = verdict.verdict() != Verdict::kInvalid;
  verdict.handled = verdict.verdict() == Verdict::kPass;
  return verdict;
}

CaseVerdict verdict_of(const Campaign& campaign, const CampaignCase& one) {
  if (one.is_duty()) {
    return verdict_of_duty(campaign, one);
  }
  if (one.faults.empty() && campaign.controller.is_bbmc()) {
    return verdict_by_budgets(campaign, one);
  }
  const auto& motion = motion_of(campaign, one);
  const auto plan = plan_of(one);
  if (!campaign.controller.is_bbmc()) {
    auto fixture = motion.plain;
    add_faults(fixture, plan);
    return judge_candidate(campaign.controller, fixture, motion.candidate_reference);
  }
  const bool on_record = one.carrier != "in-process" || plan.empty() ||
                         std::any_of(plan.begin(), plan.end(), [](const Fault& fault) {
                           return fault.row().needs == FaultNeeds::kRecord;
                         });
  if (on_record) {
    return verdict_on_record(campaign, motion, one);
  }
  const auto prepared = prepare(plan, motion.plain, *motion.reference);
  return judge_case(motion.plain, prepared, *motion.reference, motion.plain.experiment.seed);
}

// Nothing was there for the fault to act on: no edge to drop, no duty above the saturation, or a
// link that died before the motion's first edge.
bool took_no_effect(const CaseVerdict& verdict) {
  return std::any_of(verdict.checks.begin(), verdict.checks.end(), [&](const Check& check) {
    return check.verdict == Verdict::kInvalid &&
           (check.name == "edges_seen" || (check.name == "fault_fired" && !verdict.fired));
  });
}

// At the first of the case's moments at which its fault takes effect; `one` becomes that case.
CaseVerdict verdict_where_it_acts(const Campaign& campaign, CampaignCase& one, json& line) {
  auto verdict = verdict_of(campaign, one);
  std::size_t drawn = 1;
  for (const double at_s : one.further_moments_s) {
    if (!took_no_effect(verdict)) {
      break;
    }
    auto fault = parse_fault(one.faults.front());
    fault.trigger.value = at_s;
    one.faults.front() = describe(fault);
    verdict = verdict_of(campaign, one);
    ++drawn;
  }
  if (drawn > 1) {
    line["faults"] = one.faults;
    line["remarks"].push_back("the fault takes no effect at the moment drawn first: drawn again");
  }
  return verdict;
}

}  // namespace

FaultPlan plan_of(const CampaignCase& one) {
  FaultPlan plan;
  for (const auto& words : one.faults) {
    plan.push_back(parse_fault(words));
  }
  return plan;
}

std::string run_campaign_case(const Campaign& campaign, const CampaignCase& asked) {
  auto one = asked;
  auto line = identity_of(campaign, one);
  try {
    const auto verdict = verdict_where_it_acts(campaign, one, line);
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
        line["broken"].push_back(
            {{"rule", check.name}, {"reason", check.reason}, {"source", check.source}});
      } else if (!check.reason.empty()) {
        line["remarks"].push_back(check.reason);
      }
    }
    line["rules"] = std::move(rules);
  } catch (const std::exception& error) {  // a fixture, or a record that cannot be read
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
