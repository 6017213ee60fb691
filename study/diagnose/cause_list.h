// The causes that a diagnosis can name, for people: law, source, numbers, keys of the plant file.
#pragma once

#include <string>

namespace towbench::study::diagnose {

[[nodiscard]] std::string cause_list();

}  // namespace towbench::study::diagnose
