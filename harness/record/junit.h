// The checks of a run as JUnit's XML, which CI systems read: FAIL is a failure, INVALID an error.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "harness/checks/check.h"

namespace towbench::harness {

[[nodiscard]] std::string junit_xml(std::string_view suite, double wall_time_s,
                                    std::span<const Check> checks);

}  // namespace towbench::harness
