#include "protocol/carriers/candump.h"

#include <charconv>
#include <cstring>

namespace towbench::protocol {
namespace {

constexpr std::string_view kDigits = "0123456789ABCDEF";
constexpr std::size_t kMaxInterfaceName = 15;
constexpr std::size_t kFractionDigits = 6;

bool is_interface_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= kMaxInterfaceName &&
         name.find_first_of(" \t\r\n") == std::string_view::npos;
}

// Appends digits, most significant first, padded with zeros.
void append_number(char*& at, std::uint64_t value, unsigned base, std::size_t width) noexcept {
  for (std::size_t i = width; i-- > 0; value /= base) {
    at[i] = kDigits[value % base];
  }
  at += width;
}

std::size_t decimal_width(std::uint64_t value) noexcept {
  std::size_t width = 1;
  for (; value >= 10; value /= 10) {
    ++width;
  }
  return width;
}

// A token up to `end`, taken off the front of `text` together with the end.
std::optional<std::string_view> take_until(std::string_view& text, char end) noexcept {
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const auto token = text.substr(0, at);
  text.remove_prefix(at + 1);
  return token;
}

template <typename T>
std::optional<T> number(std::string_view digits, int base) noexcept {
  T value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  const bool is_whole = result.ec == std::errc() && result.ptr == digits.data() + digits.size();
  return is_whole ? std::optional(value) : std::nullopt;
}

std::optional<core::Nanoseconds> read_time(std::string_view text) noexcept {
  const auto seconds_text = take_until(text, '.');
  if (!seconds_text || text.size() != kFractionDigits) {
    return std::nullopt;
  }
  const auto seconds = number<std::uint32_t>(*seconds_text, 10);
  const auto microseconds = number<std::uint32_t>(text, 10);
  if (!seconds || !microseconds) {
    return std::nullopt;
  }
  return *seconds * core::kNanosecondsPerSecond + *microseconds * core::kNanosecondsPerMicrosecond;
}

std::optional<CanFrame> read_frame(std::string_view text) noexcept {
  constexpr std::size_t kStandardIdDigits = 3;
  const auto id_text = take_until(text, '#');
  if (!id_text || id_text->size() != kStandardIdDigits) {
    return std::nullopt;
  }
  const auto id = number<std::uint32_t>(*id_text, 16);
  std::string_view data = text.substr(0, text.find_first_of(" \t\r\n"));
  const bool is_fd = data.starts_with('#');
  if (is_fd) {
    if (data.size() < 2 || !number<std::uint8_t>(data.substr(1, 1), 16)) {
      return std::nullopt;
    }
    data.remove_prefix(2);
  }
  const std::size_t size = data.size() / 2;
  const bool is_sized =
      is_fd ? size <= kCanFdDataSize && can_fd_size(size) == size : size <= kCanDataSize;
  if (!id || *id > kMaxStandardId || data.size() % 2 != 0 || !is_sized) {
    return std::nullopt;
  }
  CanFrame frame{.id = *id, .size = static_cast<std::uint8_t>(size), .is_fd = is_fd};
  for (std::size_t i = 0; i < frame.size; ++i) {
    const auto byte = number<std::uint8_t>(data.substr(2 * i, 2), 16);
    if (!byte) {
      return std::nullopt;
    }
    frame.data[i] = *byte;
  }
  return frame;
}

}  // namespace

std::string_view write_candump(const CandumpLine& line, std::span<char> into) noexcept {
  if (into.size() < kMaxCandumpLine || line.time_ns < 0 || !is_interface_name(line.interface)) {
    return {};
  }
  const auto microseconds =
      static_cast<std::uint64_t>(line.time_ns / core::kNanosecondsPerMicrosecond);
  constexpr std::uint64_t kMicrosecondsPerSecond = 1'000'000;
  const std::uint64_t seconds = microseconds / kMicrosecondsPerSecond;
  char* at = into.data();
  *at++ = '(';
  append_number(at, seconds, 10, decimal_width(seconds));
  *at++ = '.';
  append_number(at, microseconds % kMicrosecondsPerSecond, 10, kFractionDigits);
  *at++ = ')';
  *at++ = ' ';
  std::memcpy(at, line.interface.data(), line.interface.size());
  at += line.interface.size();
  *at++ = ' ';
  append_number(at, line.frame.id, 16, 3);
  *at++ = '#';
  if (line.frame.is_fd) {
    constexpr char kRateSwitched = '1';
    *at++ = '#';
    *at++ = kRateSwitched;
  }
  for (const std::uint8_t byte : line.frame.view()) {
    append_number(at, byte, 16, 2);
  }
  return {into.data(), static_cast<std::size_t>(at - into.data())};
}

std::optional<CandumpLine> read_candump(std::string_view text) noexcept {
  if (text.empty() || text.front() != '(') {
    return std::nullopt;
  }
  text.remove_prefix(1);
  const auto time_text = take_until(text, ')');
  if (!time_text || text.empty() || text.front() != ' ') {
    return std::nullopt;
  }
  text.remove_prefix(1);
  const auto interface = take_until(text, ' ');
  if (!interface || !is_interface_name(*interface)) {
    return std::nullopt;
  }
  const auto time_ns = read_time(*time_text);
  const auto frame = read_frame(text);
  if (!time_ns || !frame) {
    return std::nullopt;
  }
  return CandumpLine{*time_ns, *interface, *frame};
}

}  // namespace towbench::protocol
