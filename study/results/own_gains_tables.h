// Tables 7.2, 7.6, 8.3 and Figs 7.14, 7.15 with the thesis's own gains, and which unit of Table 7.6
// they support.
#pragma once

#include <string>
#include <vector>

#include "study/results/own_gains.h"

namespace towbench::study {

// Markdown.
[[nodiscard]] std::string own_gains_tables(const std::vector<OwnGains>& all);

}  // namespace towbench::study
