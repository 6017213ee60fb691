#include "tests/study/diagnose/foreign/answer.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "study/diagnose/diagnosis_json.h"

namespace towbench::tests::foreign {
namespace {

using Json = nlohmann::json;
using namespace nlohmann::literals;

Named named(const std::string& name, const Json& entry) {
  Named out{{name}, 1};
  for (const Json& other : entry.at("indistinguishable_from")) {
    out.names.push_back(other.get<std::string>());
  }
  const auto p_value = entry.find("p_value");
  if (p_value != entry.end() && p_value->is_number()) {
    out.p_value = p_value->get<double>();
  }
  return out;
}

}  // namespace

std::string Answer::words() const {
  std::string all;
  for (const Named& cause : causes) {
    all += all.empty() ? "" : " ";
    for (std::size_t i = 0; i < cause.names.size(); ++i) {
      all += (i == 0 ? "" : "~") + cause.names[i];
    }
  }
  return all.empty() ? "nothing" : all;
}

Answer answer_of(const study::diagnose::Diagnosis& diagnosis) {
  const Json json = Json::parse(study::diagnose::diagnosis_json(diagnosis));
  Answer answer;
  for (const Json& finding : json.at("findings")) {
    if (finding.at("fatal").get<bool>()) {
      answer.refusal = finding.at("name").get<std::string>();
      return answer;
    }
  }
  for (const Json& cause : json.at("causes")) {
    answer.causes.push_back(named(cause.at("effect").get<std::string>(), cause));
  }
  for (const auto& [name, entry] : json.at("parameters").items()) {
    answer.causes.push_back(named(name, entry));
  }
  const Json& verdicts = json.at("verdict");
  answer.unexplained = !json.at("unexplained").is_null();
  answer.adequate = std::find(verdicts.begin(), verdicts.end(), "model_adequate") != verdicts.end();
  const Json gain = json.value("/heldout/gain_pct/value"_json_pointer, Json());
  answer.gain_pct = gain.is_number() ? gain.get<double>() : 0;
  return answer;
}

}  // namespace towbench::tests::foreign
