#include "harness/fmi/axis_export.h"

#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <variant>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/time.h"
#include "emulator/fmi/axis_variables.h"
#include "emulator/fmi/fmi3.h"
#include "emulator/fmi/parameter_lines.h"
#include "harness/files/regular_file.h"
#include "harness/fmi/fmu_archive.h"

namespace towbench::harness {
namespace {

using fmi3::AxisVariable;
using fmi3::AxisVariableRow;
using fmi3::Causality;

// Exponents of kg, m, s, A, rad.
struct UnitRow {
  const char* name;
  std::array<int, 5> exponents;
};
constexpr std::array kUnits{UnitRow{"s", {0, 0, 1, 0, 0}},      UnitRow{"V", {1, 2, -3, -1, 0}},
                            UnitRow{"N", {1, 1, -2, 0, 0}},     UnitRow{"m", {0, 1, 0, 0, 0}},
                            UnitRow{"m/s", {0, 1, -1, 0, 0}},   UnitRow{"rad", {0, 0, 0, 0, 1}},
                            UnitRow{"rad/s", {0, 0, -1, 0, 1}}, UnitRow{"A", {0, 0, 0, 1, 0}}};

std::string axis_parameters(const emulator::RigParameters& rig, core::Axis which) {
  auto axis = rig.axes[which];
  auto supply_V = rig.supply.voltage_V;
  fmi3::LineWriter writer;
  axis.plant.visit(writer);
  writer.value("start_m", axis.start_m, {}, "");
  writer.value("supply_V", supply_V, {}, "");
  return writer.text();
}

void add_units(pugi::xml_node root) {
  constexpr std::array kBases{"kg", "m", "s", "A", "rad"};
  auto units = root.append_child("UnitDefinitions");
  for (const auto& row : kUnits) {
    auto unit = units.append_child("Unit");
    unit.append_attribute("name") = row.name;
    auto base = unit.append_child("BaseUnit");
    for (std::size_t i = 0; i < kBases.size(); ++i) {
      if (row.exponents[i] != 0) {
        base.append_attribute(kBases[i]) = row.exponents[i];
      }
    }
  }
}

std::string start_of(const AxisVariableRow& row, const emulator::RigParameters& rig,
                     core::Axis axis) {
  switch (row.reference) {
    case AxisVariable::kSupply:
      return fmt::format("{}", rig.supply.voltage_V);
    case AxisVariable::kStart:
      return fmt::format("{}", rig.axes[axis].start_m);
    case AxisVariable::kEnabled:
      return "true";
    default:
      return "0";
  }
}

void add_variable(pugi::xml_node variables, const AxisVariableRow& row, const std::string& start) {
  constexpr std::array kCausalities{"independent", "input", "parameter", "output"};
  const bool is_boolean = row.reference == AxisVariable::kEnabled;
  auto variable = variables.append_child(is_boolean ? "Boolean" : "Float64");
  variable.append_attribute("name") = std::string(row.name).c_str();
  variable.append_attribute("valueReference") = static_cast<unsigned>(row.reference);
  variable.append_attribute("description") = std::string(row.meaning).c_str();
  variable.append_attribute("causality") = kCausalities[static_cast<std::size_t>(row.causality)];
  const bool is_fixed = row.causality == Causality::kParameter;
  variable.append_attribute("variability") = is_fixed     ? "fixed"
                                             : is_boolean ? "discrete"
                                                          : "continuous";
  if (!is_boolean) {
    variable.append_attribute("unit") = std::string(row.unit).c_str();
  }
  if (row.causality == Causality::kInput || is_fixed) {
    variable.append_attribute("start") = start.c_str();
  }
}

std::string bytes_of(const std::filesystem::path& file) {
  auto bytes = read_regular_file(file, 1U << 28U);
  if (const auto* unreadable = std::get_if<Unreadable>(&bytes)) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), unreadable->what));
  }
  return std::get<std::string>(std::move(bytes));
}

}  // namespace

std::string axis_description(const std::string& name, const emulator::RigParameters& rig,
                             core::Axis axis) {
  pugi::xml_document document;
  auto declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  auto root = document.append_child("fmiModelDescription");
  root.append_attribute("fmiVersion") = fmi3::kVersion;
  root.append_attribute("modelName") = name.c_str();
  root.append_attribute("instantiationToken") = fmt::format("{:016x}", rig.fixture_hash).c_str();
  root.append_attribute("generationTool") = "towbench";
  root.append_attribute("variableNamingConvention") = "flat";
  auto unit = root.append_child("CoSimulation");
  unit.append_attribute("modelIdentifier") = std::string(fmi3::kAxisModel).c_str();
  unit.append_attribute("canHandleVariableCommunicationStepSize") = true;
  unit.append_attribute("fixedInternalStepSize") = core::kPlantTick_s;
  unit.append_attribute("canGetAndSetFMUState") = true;
  add_units(root);
  auto experiment = root.append_child("DefaultExperiment");
  experiment.append_attribute("startTime") = 0;
  experiment.append_attribute("stepSize") = core::kPlantTick_s;
  auto variables = root.append_child("ModelVariables");
  auto structure = root.append_child("ModelStructure");
  for (const auto& row : fmi3::kAxisVariables) {
    add_variable(variables, row, start_of(row, rig, axis));
  }
  for (const char* kind : {"Output", "InitialUnknown"}) {
    for (const auto& row : fmi3::kAxisVariables) {
      if (row.causality == Causality::kOutput) {
        structure.append_child(kind).append_attribute("valueReference") =
            static_cast<unsigned>(row.reference);
      }
    }
  }
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

void export_axis(const std::filesystem::path& file, const std::string& name,
                 const emulator::RigParameters& rig, core::Axis axis,
                 const std::filesystem::path& binary) {
  const auto library = fmt::format("binaries/{}/{}.so", fmi3::kPlatform, fmi3::kAxisModel);
  write_fmu(file,
            {{"modelDescription.xml", axis_description(name, rig, axis)},
             {library, bytes_of(binary)},
             {fmt::format("resources/{}", fmi3::kAxisParameterFile), axis_parameters(rig, axis)}});
}

}  // namespace towbench::harness
