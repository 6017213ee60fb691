// Machines of structures that no estimator of identify/ assumes. What of them is a parameter of the
// two-mass model, J, B, C, K_T and so on, keeps its value and so has a truth; the rest is off in
// the nominal machine.
#pragma once

#include <span>
#include <string_view>

#include "emulator/rig_parameters.h"

namespace towbench::study {

struct ForeignStructure {
  std::string_view name;
  std::string_view what;    // with its size
  std::string_view source;  // of the size
  void (*build)(emulator::AxisParameters& axis);
};

// The first is no foreign one: the model's own structure, to compare with.
[[nodiscard]] std::span<const ForeignStructure> foreign_structures() noexcept;
// Null when there is none of that name.
[[nodiscard]] const ForeignStructure* find_structure(std::string_view name) noexcept;

// On both axes.
[[nodiscard]] emulator::RigParameters built(emulator::RigParameters rig,
                                            const ForeignStructure& structure);

}  // namespace towbench::study
