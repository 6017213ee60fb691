// What was done and found, as one page that needs nothing but a browser.
#pragma once

#include <string>
#include <vector>

#include "study/procedures/sequence.h"
#include "study/recovery/recovery.h"

namespace towbench::study::procedures {

// `recoveries` empty: the machine's own parameters are not set beside.
[[nodiscard]] std::string study_page(const std::string& title, const SequenceResult& result,
                                     const std::vector<Recovery>& recoveries);

}  // namespace towbench::study::procedures
