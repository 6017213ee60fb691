#include "tests/protocol/golden.h"

namespace towbench::protocol {
namespace {

constexpr core::Nanoseconds kTime_ns = 0x0102030405060708;
constexpr std::uint32_t kSequence = 0x11223344;

const Hello kControllerHello{.version = 2,
                             .role = Role::kController,
                             .axes_mask = 3,
                             .tick_ns = 100'000,
                             .exchange_ns = 1'000'000,
                             .capabilities = kCapabilityEdges | kCapabilityDigest,
                             .fixture_hash = 0x8877665544332211};
const Hello kPlantHello{.version = 2,
                        .role = Role::kPlant,
                        .axes_mask = 1,
                        .tick_ns = 50'000,
                        .exchange_ns = 0,
                        .capabilities = kCapabilityEdges,
                        .fixture_hash = 0};

void send_edges(MessageSink& sink) {
  EncoderEdges m;
  m.axis = core::Axis::kX;
  m.start_levels = 5;
  m.start_ns = 1'000'000;
  m.end_ns = 2'000'000;
  m.sequence = kSequence;
  m.edges.assign(std::vector{EncoderEdge(1, EncoderLine::kA), EncoderEdge(3770, EncoderLine::kB),
                             EncoderEdge(0x12345, EncoderLine::kIndex)});
  sink.on(m);
}

}  // namespace

const std::vector<Golden>& golden_messages() {
  static const std::vector<Golden> messages{
      {"Hello", "01 0200 00 03 a0860100 40420f00 03000000 1122334455667788",
       [](MessageSink& s) { s.on(kControllerHello); }},
      {"HelloReply", "02 0200 01 01 50c30000 00000000 01000000 0000000000000000 9401",
       [](MessageSink& s) {
         s.on(HelloReply{kPlantHello, core::ErrorCode::kProtocolTick});
       }},
      {"PwmDuty", "03 01 01 d204 0000 8813 44332211",
       [](MessageSink& s) {
         s.on(PwmDuty{.axis = core::Axis::kX,
                      .enable = true,
                      .channel_a_ticks = 1234,
                      .channel_b_ticks = 0,
                      .period_ticks = 5000,
                      .sequence = kSequence});
       }},
      {"EncoderEdges",
       "04 01 05 40420f0000000000 80841e0000000000 44332211 0300 01000000 ba0e0040 45230180",
       send_edges},
      {"EncoderReport",
       "05 00 03 0807060504030201 feffffff 0706050403020100 ba0e0000 10270000 0100 0200 44332211",
       [](MessageSink& s) {
         s.on(EncoderReport{.axis = core::Axis::kY,
                            .levels = 3,
                            .time_ns = kTime_ns,
                            .count_change = -2,
                            .last_edge_ns = 0x01020304050607,
                            .capture_period_ns = 3770,
                            .index_count = 10000,
                            .index_pulses = 1,
                            .illegal_transitions = 2,
                            .sequence = kSequence});
       }},
      {"DigitalInputs", "06 51000200 0807060504030201 44332211",
       [](MessageSink& s) {
         s.on(DigitalInputs{mask_of(InputLine::kHallYMin) | mask_of(InputLine::kKillSwitch) |
                                mask_of(InputLine::kAmplifierReadyX) | mask_of(InputLine::kHomeX),
                            kTime_ns, kSequence});
       }},
      {"DigitalOutputs", "07 8200 0807060504030201 44332211",
       [](MessageSink& s) {
         s.on(DigitalOutputs{static_cast<std::uint16_t>(mask_of(OutputLine::kAmplifierEnableX) |
                                                        mask_of(OutputLine::kBrakeReleaseX)),
                             kTime_ns, kSequence});
       }},
      // IEEE-754 binary32: 1 = 3f800000, -2 = c0000000, 0.5 = 3f000000, 10 = 41200000.
      {"ForceSample", "08 0807060504030201 0000803f 000000c0 0000003f 00002041 00000000 00000080",
       [](MessageSink& s) {
         s.on(ForceSample{kTime_ns, {1.0F, -2.0F, 0.5F}, {10.0F, 0.0F, -0.0F}});
       }},
      {"CurrentSample", "09 01 0807060504030201 000000c0",
       [](MessageSink& s) {
         s.on(CurrentSample{core::Axis::kX, kTime_ns, -2.0F});
       }},
      {"Advance", "0a 0807060504030201", [](MessageSink& s) { s.on(Advance{kTime_ns}); }},
      {"Advanced", "0b 0807060504030201", [](MessageSink& s) { s.on(Advanced{kTime_ns}); }},
      {"Heartbeat", "0c 0807060504030201 44332211",
       [](MessageSink& s) {
         s.on(Heartbeat{kTime_ns, kSequence});
       }},
      {"Fault", "0d 2c01 0807060504030201 44332211",
       [](MessageSink& s) {
         s.on(Fault{core::ErrorCode::kFaultKillSwitch, kTime_ns, kSequence});
       }},
      {"Bye", "0e 0807060504030201", [](MessageSink& s) { s.on(Bye{kTime_ns}); }},
      {"Reference", "0f 01 0807060504030201 0000803f 000000c0 0000003f",
       [](MessageSink& s) {
         s.on(Reference{core::Axis::kX, kTime_ns, 1.0F, -2.0F, 0.5F});
       }},
      {"Reset", "10 0807060504030201", [](MessageSink& s) { s.on(Reset{kTime_ns}); }},
      // -2 = fffffffe.
      {"AbsoluteCount", "11 01 0807060504030201 feffffff 44332211",
       [](MessageSink& s) {
         s.on(AbsoluteCount{core::Axis::kX, kTime_ns, -2, kSequence});
       }},
  };
  return messages;
}

std::vector<std::byte> bytes_of(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size();) {
    if (hex[i] == ' ') {
      ++i;
      continue;
    }
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    i += 2;
  }
  return bytes;
}

std::string hex_of(const std::byte* bytes, std::size_t size) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (std::size_t i = 0; i < size; ++i) {
    const auto value = std::to_integer<unsigned>(bytes[i]);
    hex += kDigits[value >> 4U];
    hex += kDigits[value & 15U];
  }
  return hex;
}

}  // namespace towbench::protocol
