#include "harness/link/refusals.h"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "protocol/handshake.h"

namespace towbench::harness {
namespace {

// What a controller does wrong; everything else that a plant notes is of the machine.
bool is_of_controller(core::ErrorCode code) {
  switch (code) {
    case core::ErrorCode::kProtocolNoHello:
    case core::ErrorCode::kMessageBadField:
    case core::ErrorCode::kSequence:
    case core::ErrorCode::kBothChannelsActive:
    case core::ErrorCode::kTimeNotMonotonic:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string Refusals::Heard::words() const {
  switch (kind) {
    case Kind::kDuty:
      return fmt::format("PwmDuty axis {}, channels {} and {} of {} ticks, sequence {}",
                         core::index_of(duty.axis), duty.channel_a_ticks, duty.channel_b_ticks,
                         duty.period_ticks, duty.sequence);
    case Kind::kOutputs:
      return fmt::format("DigitalOutputs {:#06x}, sequence {}", outputs.lines, outputs.sequence);
    case Kind::kAdvance:
      return fmt::format("Advance until {} ns", advance.until_ns);
    case Kind::kOther:
      break;
  }
  return "a message";
}

void Refusals::tell(const std::string& line) {
  if (++refused_ <= kMostTold) {
    tell_(line);
  } else if (refused_ == kMostTold + 1) {
    tell_("more is refused; it is counted only");
  }
}

void Refusals::on_event(const emulator::PlantEvent& event) noexcept {
  if (event.kind == emulator::PlantEventKind::kFault && is_of_controller(event.code)) {
    tell(fmt::format("refused at {} ns: {}: {} ({})", event.time_ns, heard_.words(),
                     core::describe(event.code), core::number_of(event.code)));
  }
  PlantRelay::on_event(event);
}

void Refusals::on_refusal(const protocol::Hello& ours, const protocol::Hello& theirs,
                          core::ErrorCode why) noexcept {
  std::array<char, 256> text{};
  tell(fmt::format("refused Hello: {} ({})", protocol::explain(why, ours, theirs, text),
                   core::number_of(why)));
  PlantRelay::on_refusal(ours, theirs, why);
}

std::string Refusals::dropped(const protocol::LinkCounts& counts) {
  std::vector<std::string> parts;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) {
      parts.push_back(fmt::format("{} {}", count, what));
    }
  };
  add(counts.bad_field, "with a field out of range");
  add(counts.unknown, "of an unknown kind");
  add(counts.bad_crc, "with a wrong checksum");
  add(counts.too_long, "too long");
  add(counts.malformed, "malformed");
  add(counts.truncated, "cut off");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace towbench::harness
