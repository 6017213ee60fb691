// Whether two sides may run together. Both judge by the same rule, so both refuse.
#pragma once

#include <span>
#include <string_view>

#include "core/result.h"
#include "protocol/messages.h"

namespace towbench::protocol {

// The first rule that is broken, in this order:
//   kProtocolVersion          versions are equal
//   kProtocolRole             one is the controller, the other the plant; an observer suits either
//   kProtocolAxes             axes are equal, and at least one
//   kProtocolTick             plant ticks are equal and > 0; the exchange time is a whole number of
//                             them, > 0, and equal unless one side leaves it to the other (0)
//   kProtocolCapabilities     encoder edges or encoder digest on both sides
//   kProtocolFixtureMismatch  fixture hashes are equal, unless one side does not know its own (0)
[[nodiscard]] core::Status compare(const Hello& ours, const Hello& theirs) noexcept;

// A sentence that names both sides, e.g. "ticks differ: controller 100000 ns, exchange 1000000 ns,
// plant 50000 ns, exchange 1000000 ns". Cut off at the end of `into`; the result is a view of it.
[[nodiscard]] std::string_view explain(core::ErrorCode refusal, const Hello& ours,
                                       const Hello& theirs, std::span<char> into) noexcept;

}  // namespace towbench::protocol
