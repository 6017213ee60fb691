// Little-endian fields of MCAP records, taken one after the other. Past the end all are zero and
// ok() is false.
#pragma once

#include <cstdint>
#include <string_view>

namespace towbench::study::logs {

class McapBytes {
 public:
  explicit McapBytes(std::string_view bytes) : left_(bytes) {}

  template <typename Unsigned>
  Unsigned number() {
    Unsigned value = 0;
    const auto bytes = take(sizeof value);
    for (std::size_t i = bytes.size(); i > 0; --i) {
      value = static_cast<Unsigned>((std::uint64_t{value} << 8U) |
                                    static_cast<std::uint8_t>(bytes[i - 1]));
    }
    return value;
  }
  std::string_view take(std::uint64_t count) {
    if (count > left_.size()) {
      ok_ = false;
      left_ = {};
      return {};
    }
    const auto taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  [[nodiscard]] std::string_view left() const noexcept { return left_; }
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  std::string_view left_;
  bool ok_ = true;
};

}  // namespace towbench::study::logs
