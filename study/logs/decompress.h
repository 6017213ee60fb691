// lz4 frames and zstd, into a size that is known before.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace towbench::study::logs {

// `method` is "", "lz4" or "zstd". Nothing for another one, for damaged data, or when the result is
// not `size` bytes long.
[[nodiscard]] std::optional<std::string> decompressed(std::string_view method,
                                                      std::string_view data, std::size_t size);

}  // namespace towbench::study::logs
