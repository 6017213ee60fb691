#include "study/diagnose/diagnosis_json.h"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace towbench::harness::diagnose {
namespace {

using Json = nlohmann::ordered_json;

Json interval(const Interval& i, double scale, const char* name) {
  return {{"value", scale * i.value}, {name, {scale * i.low, scale * i.high}}};
}

Json cause_parameters(const Cause& cause) {
  Json out = Json::object();
  for (std::size_t j = 0; j < cause.term.effect->coefficients.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const double half = 1.96 * std::sqrt(std::max(0.0, cause.covariance(i, i)));
    out[cause.term.effect->coefficients[j]] =
        interval({cause.beta[i], cause.beta[i] - half, cause.beta[i] + half}, 1, "ci95");
  }
  for (std::size_t j = 0; j < cause.term.scales.size(); ++j) {
    // Searched, not estimated with a covariance: no interval is claimed.
    out[cause.term.effect->scales[j]] = {{"value", cause.term.scales[j]}, {"ci95", nullptr}};
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
  for (std::size_t i = 0; i < d.selection.causes.size(); ++i) {
    const Cause& cause = d.selection.causes[i];
    Json alternatives = Json::array();
    for (const Alternative& alternative : cause.alternatives) {
      alternatives.push_back(alternative.term.effect->name);
    }
    out.push_back({{"effect", cause.term.effect->name},
                   {"axis", d.context.model.axis},
                   {"meaning", cause.term.effect->cause},
                   {"parameters", cause_parameters(cause)},
                   {"p_value", cause.p_value},
                   {"gain_heldout_pct", interval(cause.gain.ci99, 100, "ci99")},
                   {"indistinguishable_from", alternatives},
                   {"separating_experiment", separating(d.separating[i])}});
  }
  return out;
}

// A bias is a cause in the interface, not a parameter of the structure.
Json bias_cause(const Diagnosis& d, const ParameterShift& shift) {
  return {{"effect", "constant_bias"},
          {"axis", d.context.model.axis},
          {"meaning", find_effect("constant_bias")->cause},
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

Json findings(const Findings& all) {
  Json out = Json::array();
  for (const Finding& finding : all) {
    out.push_back({{"name", finding.name},
                   {"fatal", finding.kind == Finding::Kind::kFatal},
                   {"sentence", finding.sentence}});
  }
  return out;
}

Json heldout(const Diagnosis& d) {
  const Gain& gain = d.selection.gain;
  const auto side = [&](double rms) -> Json {
    return {{"force_error_rms_N", rms},
            {"relative_force_error_pct", 100 * rms / std::max(1e-12, d.heldout_force_rms_N)}};
  };
  Json total = interval(gain.ci95, 100, "ci95");
  total["ci99"] = {100 * gain.ci99.low, 100 * gain.ci99.high};
  return {{"baseline", side(gain.before_rms_N)},
          {"extended", side(gain.after_rms_N)},
          {"gain_pct", total},
          {"gain_over_supplied_pct", interval(d.gain_over_supplied.ci95, 100, "ci95")},
          {"same_session", d.heldout_same_session}};
}

Json improvement(const Improvement& i, double scale, const char* unit) {
  if (i.before_rms <= 0) {
    return nullptr;
  }
  return {{fmt::format("supplied_rms_{}", unit), scale * i.before_rms},
          {fmt::format("extended_rms_{}", unit), scale * i.after_rms},
          {"gain_pct", interval(i.gain, 100, "ci95")}};
}

Json confirmed(const Confirmation& c) {
  return {{"window_s", kWindow_s},
          {"windows", c.windows},
          {"position_error", improvement(c.position_m, 1e3, "mm")},
          {"closed_loop_force_error", improvement(c.force_N, 1, "N")},
          {"closed_loop_law",
           c.law == ControlLaw::Kind::kFitted ? "fitted from the log" : "tracking law"}};
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
  out["unexplained"] = nullptr;
  if (d.unexplained) {
    out["unexplained"] = {{"coordinate", d.unexplained->coordinate},
                          {"share_of_residual_pct", 100 * d.unexplained->share},
                          {"rms_N", d.unexplained->rms_N},
                          {"p_value", d.unexplained->p_value},
                          {"shape_csv", "unexplained.csv"}};
  }
  out["not_testable"] = Json::array();
  for (const NotTestable& entry : d.not_testable) {
    out["not_testable"].push_back(
        {{"effect", entry.effect}, {"why", entry.why}, {"needs", entry.needs}});
  }
  out["rejected"] = Json::array();
  for (const Rejected& entry : d.selection.rejected) {
    out["rejected"].push_back({{"effect", entry.effect},
                               {"p_value", entry.p_value},
                               {"gain_heldout_pct", interval(entry.gain, 100, "ci99")}});
  }
  out["heldout"] = heldout(d);
  out["confirmed"] = confirmed(d.confirmed);
  out["noise_floor"] = {
      {"reference_rms_N", d.selection.after.reference_rms_N},
      {"lap_to_lap_rms_N", d.lap_to_lap_rms_N ? Json(*d.lap_to_lap_rms_N) : Json(nullptr)}};
  out["method"] = {{"band_Hz", d.context.cutoff_Hz},
                   {"alpha", kAlpha},
                   {"groups_tried", d.selection.tried},
                   {"reference_controller", d.selection.after.law == ControlLaw::Kind::kFitted
                                                ? "fitted from the log"
                                                : "tracking law"}};
  return out.dump(2) + "\n";
}

void write_series(const Diagnosis& d, const std::filesystem::path& folder) {
  std::ofstream csv(folder / "residual.csv");
  csv << "time_s,position_m,speed_m_per_s,acceleration_m_per_s2,input_N,residual_before_N,"
         "residual_after_N";
  for (const Cause& cause : d.selection.causes) {
    csv << ',' << cause.term.effect->name << "_N";
  }
  csv << '\n';
  const auto at = [&](auto member) {
    return d.data.coordinate([=](const Signals& s) -> Eigen::VectorXd { return s.*member; });
  };
  const Evidence& e = d.selection.after;
  const Eigen::VectorXd force =
      d.data.stack([](const Signals& s) -> Eigen::MatrixXd { return s.force_N(); });
  Eigen::MatrixXd table(e.y.size(), 7 + static_cast<Eigen::Index>(d.selection.causes.size()));
  table.leftCols<7>() << at(&Signals::time_s), at(&Signals::position_m),
      at(&Signals::speed_m_per_s), at(&Signals::acceleration_m_per_s2), force,
      d.selection.before.residual, e.residual;
  Eigen::Index column = kBaseColumns;
  for (std::size_t i = 0; i < d.selection.causes.size(); ++i) {
    const auto& beta = d.selection.causes[i].beta;
    table.col(7 + static_cast<Eigen::Index>(i)) = e.x.middleCols(column, beta.size()) * beta;
    column += beta.size();
  }
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (Eigen::Index j = 0; j < table.cols(); ++j) {
      csv << fmt::format("{}{:.8g}", j == 0 ? "" : ",", table(row, j));
    }
    csv << '\n';
  }
  if (d.unexplained) {
    std::ofstream shape(folder / "unexplained.csv");
    shape << "coordinate,residual_N,standard_error_N\n";
    for (std::size_t i = 0; i < d.unexplained->at.size(); ++i) {
      shape << fmt::format("{:.8g},{:.8g},{:.8g}\n", d.unexplained->at[i],
                           d.unexplained->force_N[i], d.unexplained->error_N[i]);
    }
  }
}

}  // namespace towbench::harness::diagnose
