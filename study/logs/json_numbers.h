// The numbers of a JSON text with the path of each: {"a": {"b": 1}, "c": [2, 3]} has a.b, c.0, c.1.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace towbench::study::logs {

// True and false are 1 and 0; texts and null are passed over, as is what is nested deeper than
// eight levels and what follows the first 64 elements of an array. False when it is no JSON.
[[nodiscard]] bool for_each_number(
    std::string_view json, const std::function<void(const std::string& path, double value)>& take);

}  // namespace towbench::study::logs
