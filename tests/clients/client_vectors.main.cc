// Prints what the bench's own codec makes of payloads, for a client in another language to agree
// with: "VERDICT HEX" a line, then "frames HEX" and "cobs HEX" of the same stream with its
// messages.
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "protocol/cobs.h"
#include "protocol/codec.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
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
}
