#include "protocol/handshake.h"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace towbench::protocol {
namespace {

constexpr std::uint32_t kEncoderCapabilities = kCapabilityEdges | kCapabilityDigest;

bool roles_suit(Role a, Role b) noexcept {
  return a == Role::kObserver || b == Role::kObserver || a != b;
}

bool ticks_suit(const Hello& a, const Hello& b) noexcept {
  if (a.tick_ns != b.tick_ns || a.tick_ns == 0) {
    return false;
  }
  if (a.exchange_ns != 0 && b.exchange_ns != 0 && a.exchange_ns != b.exchange_ns) {
    return false;
  }
  const std::uint32_t exchange_ns = a.exchange_ns != 0 ? a.exchange_ns : b.exchange_ns;
  return exchange_ns != 0 && exchange_ns % a.tick_ns == 0;
}

std::string_view name_of(Role role) noexcept {
  switch (role) {
    case Role::kController:
      return "controller";
    case Role::kPlant:
      return "plant";
    case Role::kObserver:
      return "observer";
  }
  return "unknown role";
}

// Appends to a span and stops at its end.
class Text {
 public:
  explicit Text(std::span<char> into) noexcept : into_(into) {}

  Text& operator<<(std::string_view words) noexcept {
    const std::size_t size = std::min(words.size(), into_.size() - used_);
    if (size > 0) {
      std::memcpy(into_.data() + used_, words.data(), size);
    }
    used_ += size;
    return *this;
  }
  Text& number(std::uint64_t value, int base = 10) noexcept {
    char digits[20];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value, base).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }
  [[nodiscard]] std::string_view view() const noexcept { return {into_.data(), used_}; }

 private:
  std::span<char> into_;
  std::size_t used_ = 0;
};

void describe_axes(Text& text, std::uint8_t mask) noexcept {
  text << (mask == 0 ? "none" : "");
  for (const core::Axis axis : core::kAllAxes) {
    text << ((static_cast<unsigned>(mask) >> core::index_of(axis) & 1U) != 0 ? core::name_of(axis)
                                                                             : "");
  }
}

void describe_capabilities(Text& text, std::uint32_t capabilities) noexcept {
  const bool edges = (capabilities & kCapabilityEdges) != 0;
  const bool digest = (capabilities & kCapabilityDigest) != 0;
  text << (edges ? "edges" : "") << (edges && digest ? " and " : "") << (digest ? "digest" : "")
       << (edges || digest ? "" : "neither");
}

// What one side says about the point in question.
void describe_side(Text& text, core::ErrorCode refusal, const Hello& side) noexcept {
  text << name_of(side.role) << " ";
  switch (refusal) {
    case core::ErrorCode::kProtocolVersion:
      text.number(side.version);
      break;
    case core::ErrorCode::kProtocolAxes:
      describe_axes(text, side.axes_mask);
      break;
    case core::ErrorCode::kProtocolTick:
      text.number(side.tick_ns) << " ns, exchange ";
      text.number(side.exchange_ns) << " ns";
      break;
    case core::ErrorCode::kProtocolCapabilities:
      describe_capabilities(text, side.capabilities);
      break;
    case core::ErrorCode::kProtocolFixtureMismatch:
      text.number(side.fixture_hash, 16);
      break;
    default:
      break;
  }
}

}  // namespace

core::Status compare(const Hello& ours, const Hello& theirs) noexcept {
  using core::ErrorCode;
  if (ours.version != theirs.version) {
    return core::failure(ErrorCode::kProtocolVersion);
  }
  if (!roles_suit(ours.role, theirs.role)) {
    return core::failure(ErrorCode::kProtocolRole);
  }
  if (ours.axes_mask != theirs.axes_mask || ours.axes_mask == 0) {
    return core::failure(ErrorCode::kProtocolAxes);
  }
  if (!ticks_suit(ours, theirs)) {
    return core::failure(ErrorCode::kProtocolTick);
  }
  if ((ours.capabilities & theirs.capabilities & kEncoderCapabilities) == 0) {
    return core::failure(ErrorCode::kProtocolCapabilities);
  }
  if (ours.fixture_hash != theirs.fixture_hash && ours.fixture_hash != 0 &&
      theirs.fixture_hash != 0) {
    return core::failure(ErrorCode::kProtocolFixtureMismatch);
  }
  return {};
}

std::string_view explain(core::ErrorCode refusal, const Hello& ours, const Hello& theirs,
                         std::span<char> into) noexcept {
  Text text(into);
  text << core::describe(refusal) << ": ";
  describe_side(text, refusal, ours);
  text << ", ";
  describe_side(text, refusal, theirs);
  return text.view();
}

}  // namespace towbench::protocol
