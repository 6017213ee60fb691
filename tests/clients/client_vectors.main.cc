// Prints what the bench's own codec makes of payloads, for a client in another language to agree
// with: "VERDICT HEX" a line, then "frames HEX" and "cobs HEX" of the same stream with its
// messages. Of CAN: "can HEX", the frames of a stream to a controller, as Linux has them, and
// "can_taken HEX", what the bench's unpacker takes from them, framed by length; "can_hurt" and
// "can_hurt_taken" the same of frames of which some are lost or damaged; "can_sent HEX" and
// "can_payloads HEX" what a controller sends.
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/random.h"
#include "protocol/carriers/can_packer.h"
#include "protocol/cobs.h"
#include "protocol/codec.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/can_sinks.h"
#include "tests/protocol/counter_model.h"
#include "tests/protocol/golden.h"

namespace {

using namespace towbench;
using namespace towbench::protocol;

class Payloads final : public EachMessage<Payloads> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    std::vector<std::byte> payload(kMaxPayloadSize);
    payload.resize(encode(message, payload));
    all.push_back(std::move(payload));
  }
  std::vector<std::vector<std::byte>> all;
};

struct Bytes final : ByteSink {
  core::Status write(std::span<const std::byte> more) noexcept override {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return {};
  }
  std::vector<std::byte> bytes;
};

std::string verdict_of(std::span<const std::byte> payload) {
  static Decoder decoder;
  MessageSink nobody;
  const auto decoded = decoder.decode(payload, nobody);
  if (decoded) {
    return "ok";
  }
  switch (decoded.error()) {
    case core::ErrorCode::kMessageUnknown:
      return "unknown";
    case core::ErrorCode::kFrameTruncated:
      return "truncated";
    default:
      return "bad_field";
  }
}

void print(const char* kind, std::span<const std::byte> bytes) {
  std::printf("%s %s\n", kind, hex_of(bytes.data(), bytes.size()).c_str());
}

template <typename Framing>
void print_stream(const char* kind, const std::vector<std::vector<std::byte>>& payloads) {
  Bytes stream;
  StreamWriter<Framing> writer(stream);
  Decoder decoder;
  for (const auto& payload : payloads) {
    (void)decoder.decode(payload, writer);
  }
  (void)writer.flush();
  print(kind, stream.bytes);
}

// As struct can_frame of Linux: identifier, length, three bytes of nothing, data.
void print_frames(const char* kind, const std::vector<CanFrame>& frames) {
  std::vector<std::byte> bytes;
  for (const auto& frame : frames) {
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
      bytes.push_back(static_cast<std::byte>(frame.id >> shift));
    }
    bytes.push_back(static_cast<std::byte>(frame.size));
    bytes.resize(bytes.size() + 3);
    for (std::size_t i = 0; i < kCanDataSize; ++i) {
      bytes.push_back(static_cast<std::byte>(frame.data[i]));
    }
  }
  print(kind, bytes);
}

void print_taken(const char* kind, const std::vector<CanFrame>& frames) {
  CanUnpacker unpacker(CanDirection::kToController);
  Bytes taken;
  StreamWriter<LengthFraming> writer(taken);
  for (const auto& frame : frames) {
    unpacker.take(frame, writer);
  }
  (void)writer.flush();
  print(kind, taken.bytes);
}

std::vector<CanFrame> frames_to_controller() {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToController, frames);
  for (const auto& golden : golden_messages()) {
    golden.send(packer);
  }
  AnyMessage any(9);
  CounterModel model(6);
  for (int i = 0; i < 3000; ++i) {
    packer.on(model.next(i % 700 < 350 ? 0.4 : 20.0));
    if (i % 10 == 0) {
      any.send_to(packer);
    }
  }
  return frames.frames;
}

std::vector<CanFrame> some_lost_or_damaged(const std::vector<CanFrame>& sound) {
  core::Random random(21);
  std::vector<CanFrame> frames;
  for (CanFrame frame : sound) {
    const auto luck = random.bits() % 100;
    if (luck == 0) {
      continue;
    }
    if (luck < 3) {
      frame.data[random.bits() % kCanDataSize] ^= static_cast<std::uint8_t>(random.bits());
    }
    frame.size = luck == 4 ? static_cast<std::uint8_t>(random.bits() % 8) : frame.size;
    frames.push_back(frame);
  }
  return frames;
}

// Two sinks as one.
class Both final : public EachMessage<Both> {
 public:
  Both(MessageSink& one, MessageSink& other) : one_(one), other_(other) {}
  template <typename Message>
  void handle(const Message& message) noexcept {
    one_.on(message);
    other_.on(message);
  }

 private:
  MessageSink& one_;
  MessageSink& other_;
};

void print_sent_by_controller() {
  constexpr std::uint32_t kTurns = 33'000;  // the low bits of every sequence number wrap
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToPlant, frames);
  Bytes payloads;
  StreamWriter<LengthFraming> writer(payloads);
  Both both(packer, writer);
  both.on(Hello{.role = Role::kController, .axes_mask = 3, .capabilities = kCapabilityDigest});
  for (std::uint32_t i = 0; i < kTurns; ++i) {
    const auto ticks = static_cast<std::uint16_t>(i % 1001);
    const auto now_ns = core::kNanosecondsPerMillisecond * core::Nanoseconds{i};
    both.on(DigitalOutputs{static_cast<std::uint16_t>(i % 4), now_ns, i});
    both.on(PwmDuty{core::Axis::kY, true, ticks, 0, 1000, i});
    both.on(PwmDuty{core::Axis::kX, i % 2 == 0, 0, ticks, 1000, i});
    both.on(Advance{now_ns + core::kNanosecondsPerMillisecond});
  }
  both.on(DigitalOutputs{3, core::Nanoseconds{1} << 50U, kTurns});  // too late to be packed
  both.on(Bye{core::Nanoseconds{1} << 50U});
  (void)writer.flush();
  print_frames("can_sent", frames.frames);
  print("can_payloads", payloads.bytes);
}

}  // namespace

int main() {
  Payloads sound;
  for (const auto& golden : golden_messages()) {
    golden.send(sound);
  }
  AnyMessage any(7);
  for (int i = 0; i < 2000; ++i) {
    any.send_to(sound);
  }
  std::mt19937 random(11);
  for (const auto& payload : sound.all) {
    print(verdict_of(payload).c_str(), payload);
    auto damaged = payload;
    damaged[random() % damaged.size()] = static_cast<std::byte>(random());
    print(verdict_of(damaged).c_str(), damaged);
    damaged.resize(random() % (damaged.size() + 1));
    print(verdict_of(damaged).c_str(), damaged);
    damaged = payload;
    damaged.push_back(std::byte{0});
    print(verdict_of(damaged).c_str(), damaged);
  }
  sound.all.resize(200);
  print_stream<LengthFraming>("frames", sound.all);
  print_stream<CobsFraming>("cobs", sound.all);
  const auto frames = frames_to_controller();
  const auto hurt = some_lost_or_damaged(frames);
  print_frames("can", frames);
  print_taken("can_taken", frames);
  print_frames("can_hurt", hurt);
  print_taken("can_hurt_taken", hurt);
  print_sent_by_controller();
}
