#include "study/diagnose/diagnosis_json.h"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace towbench::study::diagnose {
namespace {

using Json = nlohmann::ordered_json;

Json interval(const Interval& i, double scale, const char* name) {
  return {{"value", scale * i.value}, {name, {scale * i.low, scale * i.high}}};
}

Json cause_parameters(const NamedCause& cause) {
  Json out = Json::object();
  for (const Size& size : cause.sizes) {
    out[size.name] = interval(size.ci95, 1, "ci95");
    if (size.known) {
      out[size.name]["ci95"] = nullptr;  // a shaft's turn: nothing was estimated
    }
  }
  return out;
}

Json separating(const std::optional<NextExperiment>& experiment) {
  if (!experiment) {
    return nullptr;
  }
  return {{"motion", experiment->motion.words()},
          {"separates_from", experiment->alternative},
          {"separation_N", experiment->separation_N},
          {"separation_in_this_data_N", experiment->in_this_data_N}};
}

Json causes(const Diagnosis& d) {
  Json out = Json::array();
  for (const NamedCause& cause : d.causes) {
    out.push_back({{"effect", cause.effect->name},
                   {"axis", d.context.stated.axis},
                   {"meaning", cause.effect->cause},
                   {"parameters", cause_parameters(cause)},
                   {"p_value", cause.p_value},
                   {"gain_heldout_pct", interval(cause.gain99, 100, "ci99")},
                   {"indistinguishable_from", cause.alternatives},
                   {"separating_experiment", separating(cause.separating)}});
  }
  return out;
}

// A bias is a cause in the interface, not a parameter of the structure.
Json bias_cause(const Diagnosis& d, const ParameterShift& shift) {
  return {{"effect", "constant_bias"},
          {"axis", d.context.stated.axis},
          {"meaning", "a constant force on the axis"},
          {"parameters", {{"force_N", interval(shift.fitted, 1, "ci95")}}},
          {"p_value", nullptr},
          {"gain_heldout_pct", nullptr},
          {"indistinguishable_from", {"coulomb_asymmetry"}},
          {"separating_experiment", nullptr}};
}

Json parameters(const Diagnosis& d) {
  Json out = Json::object();
  for (const ParameterShift& shift : d.parameters) {
    if (shift.moved && shift.name != "bias") {
      Json entry = interval(shift.fitted, 1, "ci95");
      entry["unit"] = shift.unit;
      entry["supplied"] = shift.supplied;
      entry["indistinguishable_from"] = shift.indistinguishable_from;
      out[shift.name] = entry;
    }
  }
  return out;
}

// Empty where a model states them.
Json estimated(const Diagnosis& d) {
  Json out = Json::object();
  for (const ParameterShift& shift : d.parameters) {
    if (d.estimated) {
      out[shift.name] = interval(shift.fitted, 1, "ci95");
      out[shift.name]["unit"] = shift.unit;
    }
  }
  return out;
}

Json findings(const logs::Findings& all) {
  Json out = Json::array();
  for (const logs::Finding& finding : all) {
    out.push_back({{"name", finding.name},
                   {"fatal", finding.kind == logs::Finding::Kind::kFatal},
                   {"sentence", finding.sentence}});
  }
  return out;
}

Json heldout(const Diagnosis& d) {
  const Scored& s = d.scored;
  const auto side = [&](double rms) -> Json {
    return {{"force_error_rms_N", rms},
            {"relative_force_error_pct", 100 * rms / std::max(1e-12, s.force_rms_N)}};
  };
  Json total = interval(s.gain95, 100, "ci95");
  total["ci99"] = {100 * s.gain99.low, 100 * s.gain99.high};
  return {{"supplied", side(s.supplied_rms_N)},
          {"baseline", side(s.before_rms_N)},
          {"extended", side(s.after_rms_N)},
          {"gain_pct", total},
          {"gain_over_supplied_pct", interval(s.over_supplied95, 100, "ci95")},
          {"same_session", s.same_session}};
}

// Null where there is none.
Json position_error(const Windows& w) {
  if (w.count == 0) return nullptr;
  return {{"supplied_rms_mm", 1e3 * w.supplied_m},
          {"extended_rms_mm", 1e3 * w.extended_m},
          {"gain_pct", interval(w.gain95, 100, "ci95")}};
}

Json free_run(const FreeRun& f) {
  Json out{{"window_s", kWindow_s},
           {"windows", f.windows.count},
           {"whole_run_rms_mm",
            {{"supplied", 1e3 * f.whole_supplied_m},
             {"refitted", 1e3 * f.whole_refitted_m},
             {"extended", 1e3 * f.whole_extended_m}}},
           {"position_error", position_error(f.windows)}};
  if (f.windows.count > 0) out["position_error"]["refitted_rms_mm"] = 1e3 * f.refitted_m;
  return out;
}

Json emulated(const std::optional<Emulated>& e) {
  if (!e) return nullptr;
  return {{"window_s", kWindow_s},
          {"windows", e->windows.count},
          {"whole_run_rms_mm",
           {{"supplied", 1e3 * e->whole_supplied_m}, {"extended", 1e3 * e->whole_extended_m}}},
          {"position_error", position_error(e->windows)},
          {"left_out", e->left_out}};
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  Json out{{"schema", "towbench/diagnosis/1"},
           {"verdict", is_fatal(d.findings) ? Json::array() : Json(d.verdicts)},
           {"findings", findings(d.findings)}};
  if (is_fatal(d.findings)) {
    return out.dump(2) + "\n";
  }
  out["causes"] = causes(d);
  for (const ParameterShift& shift : d.parameters) {
    if (shift.moved && shift.name == "bias") {
      out["causes"].push_back(bias_cause(d, shift));
    }
  }
  out["parameters"] = parameters(d);
  out["estimated"] = estimated(d);
  out["unexplained"] = nullptr;
  if (d.unexplained) {
    out["unexplained"] = {
        {"coordinate", d.unexplained->coordinate},
        {"share_of_residual_pct", 100 * d.unexplained->share},
        {"rms_N", d.unexplained->rms_N},
        {"p_value", d.unexplained->p_value},
        {"shape_csv", d.unexplained->at.empty() ? Json(nullptr) : Json("unexplained.csv")}};
  }
  out["not_testable"] = Json::array();
  for (const NotTestable& entry : d.not_testable) {
    out["not_testable"].push_back(
        {{"effect", entry.effect}, {"why", entry.why}, {"needs", entry.needs}});
  }
  out["rejected"] = Json::array();
  for (const Refused& entry : d.refused) {
    out["rejected"].push_back({{"effect", entry.effect},
                               {"p_value", entry.p_value},
                               {"gain_heldout_pct", interval(entry.gain99, 100, "ci99")}});
  }
  out["refuted"] = d.refuted;
  out["heldout"] = heldout(d);
  out["confirmed"] = free_run(d.free_run);
  out["emulated"] = emulated(d.emulated);
  out["noise_floor"] = {{"innovations_rms_m", d.innovations_m},
                        {"encoder_step_m", d.context.resolution_m}};
  out["method"] = {
      {"bandwidth_rad_per_s", d.bandwidth}, {"alpha", Limits{}.alpha}, {"groups_tried", d.tried}};
  return out.dump(2) + "\n";
}

void write_series(const Diagnosis& d, const std::filesystem::path& folder) {
  std::ofstream csv(folder / "residual.csv");
  csv << "time_s,position_m,speed_m_per_s,acceleration_m_per_s2,input_N,residual_before_N,"
         "residual_after_N";
  for (const NamedCause& cause : d.causes) {
    csv << ',' << cause.effect->name << "_N";
  }
  csv << '\n';
  const Series& s = d.series;
  Eigen::MatrixXd table(s.time_s.size(), 7 + s.by_cause_N.cols());
  table << s.time_s, s.position_m, s.speed_m_per_s, s.acceleration_m_per_s2, s.input_N,
      s.refitted_N, s.extended_N, s.by_cause_N;
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (Eigen::Index j = 0; j < table.cols(); ++j) {
      csv << fmt::format("{}{:.8g}", j == 0 ? "" : ",", table(row, j));
    }
    csv << '\n';
  }
  if (d.unexplained && !d.unexplained->at.empty()) {
    std::ofstream shape(folder / "unexplained.csv");
    shape << "coordinate,residual_N,standard_error_N\n";
    for (std::size_t i = 0; i < d.unexplained->at.size(); ++i) {
      shape << fmt::format("{:.8g},{:.8g},{:.8g}\n", d.unexplained->at[i],
                           d.unexplained->force_N[i], d.unexplained->error_N[i]);
    }
  }
}

}  // namespace towbench::study::diagnose
