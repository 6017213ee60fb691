// Work that is independent, on the processors there are.
#pragma once

#include <cstddef>
#include <functional>

namespace towbench::study::diagnose {

// Calls `work` for 0 .. count-1.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace towbench::study::diagnose
