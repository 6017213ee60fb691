// SHA-256 and HMAC-SHA-256, of OpenSSL's libcrypto, as lower-case hex digits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace towbench::harness {

// What a file holds, as far as it can be stated without keeping it. A file that cannot be read has
// no digest.
struct FileDigest {
  std::string sha256;  // 64 hex digits, or empty: not readable
  std::uint64_t bytes = 0;
  std::uint64_t lines = 0;  // ends of lines

  [[nodiscard]] bool operator==(const FileDigest&) const = default;
};

// Regular files only: nothing here waits for a pipe or reads a device.
[[nodiscard]] FileDigest digest_of(const std::filesystem::path& file);

[[nodiscard]] std::string sha256(std::string_view text);
[[nodiscard]] std::string hmac_sha256(std::string_view key, std::string_view text);

}  // namespace towbench::harness
