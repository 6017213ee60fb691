// [[event]] of an experiment file, read and written: what a person does to the machine, and the
// operator to its controller.
#pragma once

#include <string>
#include <vector>

#include "emulator/faults/scheduled_event.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Sorted by time. Throws FixtureError; for a reset too, unless the controller `takes_reset`: that
// of a controller with a console is typed.
[[nodiscard]] std::vector<emulator::ScheduledEvent> read_events(TableReader& experiment,
                                                                bool takes_reset);
[[nodiscard]] std::string to_toml(const emulator::ScheduledEvent& event);

}  // namespace towbench::harness
