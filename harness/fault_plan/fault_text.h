// Faults in words: from the command line and from fixtures, and back into a fixture.
//
//   endstop.y_max stuck_open at=2s for=0.5s
//   encoder.y jump phase=cruise after=20ms counts=400 seed=7
//
// On the command line a value has its unit (at=20ms, force=10N) or its key has (at_s=0.02); in a
// fixture the key has. Whatever is not understood, out of range or without effect
// is refused with one line.
#pragma once

#include <string>
#include <string_view>

#include "harness/fault_plan/fault.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Throws FixtureError.
[[nodiscard]] Fault parse_fault(std::string_view words);
// One [[fault]] table. Throws FixtureError.
[[nodiscard]] Fault read_fault(TableReader& reader);
// Every [[fault]] of a file with `schema`, `name` and `title`. Throws FixtureError.
[[nodiscard]] FaultPlan read_fault_plan(const FixtureFile& file);
// As a [[fault]] table of TOML that reads back as the same fault.
[[nodiscard]] std::string to_toml(const Fault& fault);

}  // namespace towbench::harness
