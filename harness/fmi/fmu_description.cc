#include "harness/fmi/fmu_description.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace towbench::harness {
namespace {

bool is_identifier(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
}

void add_variable(const pugi::xml_node& node, FmuDescription& description) {
  const std::string type = node.name();
  if ((type != "Float64" && type != "Boolean") || node.child("Dimension")) {
    return;
  }
  description.variables[node.attribute("name").value()] = {
      .reference = node.attribute("valueReference").as_uint(),
      .is_boolean = type == "Boolean",
      .causality = node.attribute("causality").as_string("local")};
}

}  // namespace

std::string read_description(const std::string& xml, FmuDescription& description) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size());
  const auto root = document.child("fmiModelDescription");
  if (!parsed || !root) {
    return fmt::format("has a modelDescription.xml that is none: {}", parsed.description());
  }
  const std::string version = root.attribute("fmiVersion").value();
  if (!version.starts_with("3.")) {
    return fmt::format("is of FMI {}, not 3.0", version);
  }
  const auto unit = root.child("CoSimulation");
  if (!unit) {
    return "offers no Co-Simulation";
  }
  description.identifier = unit.attribute("modelIdentifier").value();
  if (!is_identifier(description.identifier)) {
    return "has a modelIdentifier that is no identifier";
  }
  description.token = root.attribute("instantiationToken").value();
  description.fixed_step_s = unit.attribute("fixedInternalStepSize").as_double();
  description.serializes_state = unit.attribute("canGetAndSetFMUState").as_bool() &&
                                 unit.attribute("canSerializeFMUState").as_bool();
  for (const auto& node : root.child("ModelVariables").children()) {
    add_variable(node, description);
  }
  return {};
}

}  // namespace towbench::harness
