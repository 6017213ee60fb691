#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {

using namespace study::diagnose;

NominalModel nominal_of(const HiddenAxis& axis) {
  NominalModel m;
  m.mass_kg = axis.mass_kg;
  m.viscous_N_s_per_m = axis.viscous_N_s_per_m;
  m.coulomb_N = axis.coulomb_N;
  m.metres_per_motor_rad = 1 / (axis.motor_turns_per_m * 6.283185307179586);
  m.output_radius_m = axis.output_radius_m;
  m.metres_per_count = 1 / axis.counts_per_m;
  m.newton_per_duty_pct = axis.newton_per_duty_pct;
  m.force_limit_N = 69.1;
  m.no_load_speed_m_per_s = 0.57;
  return m;
}

Run run_of(const HiddenAxis& axis, const HiddenLog& log) {
  Run run;
  run.name = "hidden";
  run.period_s = axis.period_s;
  const auto n = static_cast<Eigen::Index>(log.time_s.size());
  run.position_m = Eigen::Map<const Eigen::VectorXd>(log.position_m.data(), n);
  if (!axis.open_loop) {
    run.reference_m = Eigen::Map<const Eigen::VectorXd>(log.reference_m.data(), n);
  }
  run.input_N =
      axis.newton_per_duty_pct * Eigen::Map<const Eigen::VectorXd>(log.duty_pct.data(), n);
  run.missing.assign(log.time_s.size(), 0);
  run.resolution_m = 1 / axis.counts_per_m;
  run.input_step_N = axis.duty_step_pct * axis.newton_per_duty_pct;
  return run;
}

Diagnosis diagnose_hidden(const HiddenAxis& axis, std::uint64_t seed) {
  Request request;
  request.model = nominal_of(axis);
  request.runs = {run_of(axis, make_hidden_log(axis, seed))};
  return study::diagnose::diagnose(request);
}

std::vector<std::vector<std::string>> named(const Diagnosis& d) {
  std::vector<std::vector<std::string>> out;
  for (const NamedCause& cause : d.causes) {
    std::vector<std::string> names{cause.effect->name};
    names.insert(names.end(), cause.alternatives.begin(), cause.alternatives.end());
    out.push_back(std::move(names));
  }
  for (const ParameterShift& shift : d.parameters) {
    if (shift.moved) {
      std::vector<std::string> names{shift.name};
      names.insert(names.end(), shift.indistinguishable_from.begin(),
                   shift.indistinguishable_from.end());
      out.push_back(std::move(names));
    }
  }
  return out;
}

}  // namespace towbench::tests
