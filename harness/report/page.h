// From sections to one HTML document.
#pragma once

#include <span>
#include <string>

#include "harness/report/run_contents.h"

namespace towbench::harness::report {

[[nodiscard]] std::string run_page(const RunContents& run);
[[nodiscard]] std::string combined_page(std::span<const RunContents> runs);

}  // namespace towbench::harness::report
