// The other side of a mailbox: a process that holds one plant binary and does what it is told.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

#include "harness/foreign_plant/loaded_plant.h"
#include "harness/foreign_plant/mailbox.h"

namespace towbench::harness {

// Starts it; its first answer says whether the binary could be loaded. It ends with the thread that
// started it. Throws std::system_error.
[[nodiscard]] pid_t start_plant_host(const PlantBinary& binary, const std::vector<PlantAxis>& axes,
                                     Mailbox& mailbox);

}  // namespace towbench::harness
