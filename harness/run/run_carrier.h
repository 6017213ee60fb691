// Carriers as a user names them.
#pragma once

#include <string>

#include "harness/fault_plan/carrier_fit.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

inline constexpr const char* kCarrierHelp =
    "in-process; local: the emulator in a process of its own; serial-pty: the same over two "
    "pseudo-terminals; serial:DEVICE,DEVICE[@BAUD] or can:INTERFACE[,INTERFACE][@fd]: the same "
    "over wires";

// One of these; empty: in-process. Throws FixtureError.
void choose_carrier(const std::string& text, RunOptions& options);

[[nodiscard]] CarrierKind kind_of(const RunOptions& options) noexcept;

}  // namespace towbench::harness
