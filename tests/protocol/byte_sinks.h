// Byte sinks for tests of writers.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/byte_stream.h"

namespace towbench::protocol {

class KeepingByteSink final : public ByteSink {
 public:
  core::Status write(std::span<const std::byte> part) noexcept override {
    ++writes;
    if (failure != core::ErrorCode::kNone) {
      return core::failure(failure);
    }
    bytes.insert(bytes.end(), part.begin(), part.end());
    return {};
  }
  std::vector<std::byte> bytes;
  int writes = 0;
  core::ErrorCode failure = core::ErrorCode::kNone;
};

}  // namespace towbench::protocol
