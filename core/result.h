// A value or a numbered error; no exception crosses a public function of core, protocol, emulator
// or bbmc. tl::expected is std::expected for C++20 toolchains, bare metal included.
#pragma once

#include <tl/expected.hpp>

#include "core/error.h"

namespace towbench::core {

template <typename T>
using Result = tl::expected<T, ErrorCode>;

using Status = Result<void>;

[[nodiscard]] inline tl::unexpected<ErrorCode> failure(ErrorCode code) noexcept {
  return tl::unexpected<ErrorCode>(code);
}

}  // namespace towbench::core
