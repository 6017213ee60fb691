#include "protocol/codec.h"

#include <type_traits>

#include "protocol/id_of.h"
#include "protocol/wire.h"
#include "protocol/wire_fields.h"

namespace towbench::protocol {
namespace {

class ByteCounter {
 public:
  template <typename Message>
  using Field = const Message;

  template <typename T>
  constexpr void value(const T& /*field*/) noexcept {
    size_ += sizeof(T);
  }
  template <typename T, typename Legal>
  constexpr void checked(const T& /*field*/, Legal /*is_legal*/) noexcept {
    size_ += sizeof(T);
  }
  constexpr void flag(const bool& /*field*/) noexcept { ++size_; }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }

 private:
  std::size_t size_ = 0;
};

class Writer {
 public:
  template <typename Message>
  using Field = const Message;

  explicit Writer(std::byte* at) noexcept : at_(at) {}

  template <typename T>
  void value(const T& field) noexcept {
    store_little_endian(at_, field);
    at_ += sizeof(T);
  }
  template <typename T, typename Legal>
  void checked(const T& field, Legal /*is_legal*/) noexcept {
    value(field);
  }
  void flag(const bool& field) noexcept { value(static_cast<std::uint8_t>(field ? 1 : 0)); }
  [[nodiscard]] std::byte* at() const noexcept { return at_; }

 private:
  std::byte* at_;
};

class Reader {
 public:
  template <typename Message>
  using Field = Message;

  explicit Reader(const std::byte* at) noexcept : at_(at) {}

  template <typename T>
  void value(T& field) noexcept {
    field = load_little_endian<T>(at_);
    at_ += sizeof(T);
  }
  template <typename T, typename Legal>
  void checked(T& field, Legal is_legal) noexcept {
    value(field);
    good_ &= is_legal(field);
  }
  void flag(bool& field) noexcept {
    const auto byte = load_little_endian<std::uint8_t>(at_++);
    field = byte == 1;
    good_ &= byte <= 1;
  }
  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] const std::byte* at() const noexcept { return at_; }

 private:
  const std::byte* at_;
  bool good_ = true;
};

// Size of the message without its id. EncoderEdges: without count and edges.
template <typename Message>
std::size_t fields_size() noexcept {
  ByteCounter counter;
  if constexpr (std::is_same_v<Message, EncoderEdges>) {
    return kEdgesHeaderSize - 1 - sizeof(std::uint16_t);
  } else {
    wire_fields(counter, Message{});
    return counter.size();
  }
}

template <typename Message>
std::size_t payload_size() noexcept {
  return 1 + fields_size<Message>();
}

template <typename Message>
std::size_t encode_fixed(const Message& message, std::span<std::byte> into) noexcept {
  const std::size_t size = payload_size<Message>();
  if (into.size() < size) {
    return 0;
  }
  Writer writer(into.data());
  writer.value(IdOf<Message>::value);
  wire_fields(writer, message);
  return size;
}

template <typename Message>
core::Status decode_fixed(std::span<const std::byte> payload, MessageSink& sink) noexcept {
  const std::size_t size = payload_size<Message>();
  if (payload.size() < size) {
    return core::failure(core::ErrorCode::kFrameTruncated);
  }
  Message message;
  Reader reader(payload.data() + 1);
  wire_fields(reader, message);
  bool size_is_right = payload.size() == size;
  // A later version may say more in its greeting; what we know of it is enough to refuse it.
  if constexpr (std::is_same_v<Message, Hello>) {
    size_is_right |= message.version != kProtocolVersion;
  } else if constexpr (std::is_same_v<Message, HelloReply>) {
    size_is_right |= message.plant.version != kProtocolVersion;
  }
  if (!size_is_right || !reader.good() || !is_consistent(message)) {
    return core::failure(core::ErrorCode::kMessageBadField);
  }
  sink.on(message);
  return {};
}

}  // namespace

// clang-format off
std::size_t encoded_size(const Hello& /*m*/) noexcept { return payload_size<Hello>(); }
std::size_t encoded_size(const HelloReply& /*m*/) noexcept { return payload_size<HelloReply>(); }
std::size_t encoded_size(const PwmDuty& /*m*/) noexcept { return payload_size<PwmDuty>(); }
std::size_t encoded_size(const EncoderReport& /*m*/) noexcept { return payload_size<EncoderReport>(); }
std::size_t encoded_size(const DigitalInputs& /*m*/) noexcept { return payload_size<DigitalInputs>(); }
std::size_t encoded_size(const DigitalOutputs& /*m*/) noexcept { return payload_size<DigitalOutputs>(); }
std::size_t encoded_size(const ForceSample& /*m*/) noexcept { return payload_size<ForceSample>(); }
std::size_t encoded_size(const CurrentSample& /*m*/) noexcept { return payload_size<CurrentSample>(); }
std::size_t encoded_size(const Advance& /*m*/) noexcept { return payload_size<Advance>(); }
std::size_t encoded_size(const Advanced& /*m*/) noexcept { return payload_size<Advanced>(); }
std::size_t encoded_size(const Heartbeat& /*m*/) noexcept { return payload_size<Heartbeat>(); }
std::size_t encoded_size(const Fault& /*m*/) noexcept { return payload_size<Fault>(); }
std::size_t encoded_size(const Bye& /*m*/) noexcept { return payload_size<Bye>(); }
std::size_t encoded_size(const Reference& /*m*/) noexcept { return payload_size<Reference>(); }
std::size_t encoded_size(const Reset& /*m*/) noexcept { return payload_size<Reset>(); }
std::size_t encoded_size(const AbsoluteCount& /*m*/) noexcept { return payload_size<AbsoluteCount>(); }

std::size_t encode(const Hello& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const HelloReply& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const PwmDuty& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const EncoderReport& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const DigitalInputs& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const DigitalOutputs& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const ForceSample& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const CurrentSample& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Advance& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Advanced& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Heartbeat& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Fault& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Bye& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Reference& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const Reset& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
std::size_t encode(const AbsoluteCount& m, std::span<std::byte> into) noexcept { return encode_fixed(m, into); }
// clang-format on

std::size_t encoded_size(const EncoderEdges& message) noexcept {
  return kEdgesHeaderSize + kBytesPerEdge * message.edges.size();
}

std::size_t encode(const EncoderEdges& message, std::span<std::byte> into) noexcept {
  const std::size_t size = encoded_size(message);
  if (into.size() < size) {
    return 0;
  }
  Writer writer(into.data());
  writer.value(MessageId::kEncoderEdges);
  wire_fields(writer, message);
  writer.value(static_cast<std::uint16_t>(message.edges.size()));
  std::byte* at = writer.at();
  for (const EncoderEdge edge : message.edges) {
    store_little_endian(at, edge.packed());
    at += kBytesPerEdge;
  }
  return size;
}

core::Status Decoder::decode_edges(std::span<const std::byte> payload, MessageSink& sink) noexcept {
  if (payload.size() < kEdgesHeaderSize) {
    return core::failure(core::ErrorCode::kFrameTruncated);
  }
  Reader reader(payload.data() + 1);
  wire_fields(reader, edges_);
  std::uint16_t count = 0;
  reader.checked(count, legal::edge_count);
  if (!reader.good() || payload.size() != kEdgesHeaderSize + kBytesPerEdge * count) {
    return core::failure(core::ErrorCode::kMessageBadField);
  }
  // Plain passes over 32-bit lanes, which the compiler turns into vectors: the sum of the times is
  // taken in two halves because 1024 whole ones would not fit into a lane.
  constexpr unsigned kHalfBits = 15;
  constexpr std::uint32_t kHalfMask = (1U << kHalfBits) - 1U;
  const std::byte* at = reader.at();
  std::uint32_t low_ns = 0;
  std::uint32_t high_ns = 0;
  std::uint32_t both_line_bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto packed = load_little_endian<std::uint32_t>(at + kBytesPerEdge * i);
    unpacked_[i] = EncoderEdge::from_packed(packed);
    low_ns += packed & kHalfMask;
    high_ns += (packed >> kHalfBits) & kHalfMask;
    both_line_bits |= packed & (packed << 1U);
  }
  const core::Nanoseconds length_ns = (core::Nanoseconds{high_ns} << kHalfBits) + low_ns;
  const bool lines_are_legal = both_line_bits >> 31U == 0;  // line 3 has both bits set
  // An edge whose time rounds to the end of its interval is legal there.
  if (!lines_are_legal || length_ns > edges_.end_ns - edges_.start_ns) {
    return core::failure(core::ErrorCode::kMessageBadField);
  }
  edges_.edges.assign(std::span(unpacked_).first(count));
  sink.on(edges_);
  return {};
}

core::Status Decoder::decode(std::span<const std::byte> payload, MessageSink& sink) noexcept {
  if (payload.empty()) {
    return core::failure(core::ErrorCode::kFrameTruncated);
  }
  switch (static_cast<MessageId>(payload[0])) {
    case MessageId::kHello:
      return decode_fixed<Hello>(payload, sink);
    case MessageId::kHelloReply:
      return decode_fixed<HelloReply>(payload, sink);
    case MessageId::kPwmDuty:
      return decode_fixed<PwmDuty>(payload, sink);
    case MessageId::kEncoderEdges:
      return decode_edges(payload, sink);
    case MessageId::kEncoderReport:
      return decode_fixed<EncoderReport>(payload, sink);
    case MessageId::kDigitalInputs:
      return decode_fixed<DigitalInputs>(payload, sink);
    case MessageId::kDigitalOutputs:
      return decode_fixed<DigitalOutputs>(payload, sink);
    case MessageId::kForceSample:
      return decode_fixed<ForceSample>(payload, sink);
    case MessageId::kCurrentSample:
      return decode_fixed<CurrentSample>(payload, sink);
    case MessageId::kAdvance:
      return decode_fixed<Advance>(payload, sink);
    case MessageId::kAdvanced:
      return decode_fixed<Advanced>(payload, sink);
    case MessageId::kHeartbeat:
      return decode_fixed<Heartbeat>(payload, sink);
    case MessageId::kFault:
      return decode_fixed<Fault>(payload, sink);
    case MessageId::kBye:
      return decode_fixed<Bye>(payload, sink);
    case MessageId::kReference:
      return decode_fixed<Reference>(payload, sink);
    case MessageId::kReset:
      return decode_fixed<Reset>(payload, sink);
    case MessageId::kAbsoluteCount:
      return decode_fixed<AbsoluteCount>(payload, sink);
  }
  return core::failure(core::ErrorCode::kMessageUnknown);
}

bool is_plausible(std::byte id, std::size_t size) noexcept {
  switch (static_cast<MessageId>(id)) {
    case MessageId::kHello:
      return size >= payload_size<Hello>() && size <= kMaxHelloSize;
    case MessageId::kHelloReply:
      return size >= payload_size<HelloReply>() && size <= kMaxHelloSize;
    case MessageId::kPwmDuty:
      return size == payload_size<PwmDuty>();
    case MessageId::kEncoderEdges:
      return size >= kEdgesHeaderSize && size <= kMaxPayloadSize &&
             (size - kEdgesHeaderSize) % kBytesPerEdge == 0;
    case MessageId::kEncoderReport:
      return size == payload_size<EncoderReport>();
    case MessageId::kDigitalInputs:
      return size == payload_size<DigitalInputs>();
    case MessageId::kDigitalOutputs:
      return size == payload_size<DigitalOutputs>();
    case MessageId::kForceSample:
      return size == payload_size<ForceSample>();
    case MessageId::kCurrentSample:
      return size == payload_size<CurrentSample>();
    case MessageId::kAdvance:
      return size == payload_size<Advance>();
    case MessageId::kAdvanced:
      return size == payload_size<Advanced>();
    case MessageId::kHeartbeat:
      return size == payload_size<Heartbeat>();
    case MessageId::kFault:
      return size == payload_size<Fault>();
    case MessageId::kBye:
      return size == payload_size<Bye>();
    case MessageId::kReference:
      return size == payload_size<Reference>();
    case MessageId::kReset:
      return size == payload_size<Reset>();
    case MessageId::kAbsoluteCount:
      return size == payload_size<AbsoluteCount>();
  }
  return false;
}

}  // namespace towbench::protocol
