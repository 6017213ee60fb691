// Where a test finds and leaves the files of an image that has no file system.
#pragma once

#include <cstdint>

namespace towbench::bbmc {

struct MemoryFiles {
  static constexpr std::uint32_t kInput = 0x8600'0000;
  static constexpr std::uint32_t kOutput = 0x8C00'0000;

  std::uint32_t input_size = 0;
  std::uint32_t input_taken = 0;
  std::uint32_t output_size = 0;
  std::uint32_t ended = 0;
  std::int32_t status = 0;
};

}  // namespace towbench::bbmc
