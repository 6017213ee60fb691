// What an active diagnosis has asked, run and answered, for a person and for a program.
#pragma once

#include <string>

#include "study/active/active_diagnosis.h"

namespace towbench::study::active {

// The first five lines say what was asked, run, where it lies, the answer, and why it ends there.
[[nodiscard]] std::string told(const Request& request, const Outcome& outcome);
// Schema towbench/active/1.
[[nodiscard]] std::string json_of(const Outcome& outcome);

// Both, as active.txt and active.json in request.out. Throws when it cannot.
void write_report(const Request& request, const Outcome& outcome);

}  // namespace towbench::study::active
