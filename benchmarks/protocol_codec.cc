// Cost of a message and of an edge, to bytes and back.
#include <array>

#include <benchmark/benchmark.h>

#include "benchmarks/protocol_samples.h"
#include "protocol/cobs.h"
#include "protocol/codec.h"
#include "protocol/crc.h"
#include "protocol/frame.h"

namespace towbench::protocol {
namespace {

class LastSink final : public MessageSink {
 public:
  using MessageSink::on;
  void on(const PwmDuty& m) noexcept override { benchmark::DoNotOptimize(&m); }
  void on(const Advance& m) noexcept override { benchmark::DoNotOptimize(&m); }
  void on(const EncoderEdges& m) noexcept override { benchmark::DoNotOptimize(&m); }
  void on(const EncoderReport& m) noexcept override { benchmark::DoNotOptimize(&m); }
  void on(const ForceSample& m) noexcept override { benchmark::DoNotOptimize(&m); }
};

template <typename Message>
void encode_message(benchmark::State& state, const Message& message) {
  std::array<std::byte, kMaxPayloadSize> bytes;
  for (auto _ : state) {
    benchmark::DoNotOptimize(encode(message, bytes));
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(encoded_size(message)));
}

template <typename Message>
void decode_message(benchmark::State& state, const Message& message) {
  std::array<std::byte, kMaxPayloadSize> bytes;
  const auto payload = std::span<const std::byte>(bytes).first(encode(message, bytes));
  LastSink sink;
  Decoder decoder;
  for (auto _ : state) {
    benchmark::DoNotOptimize(decoder.decode(payload, sink).has_value());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(payload.size()));
}

BENCHMARK_CAPTURE(encode_message, duty, sample_duty());
BENCHMARK_CAPTURE(decode_message, duty, sample_duty());
BENCHMARK_CAPTURE(encode_message, advance, Advance{1'000'000});
BENCHMARK_CAPTURE(decode_message, advance, Advance{1'000'000});
BENCHMARK_CAPTURE(encode_message, report, EncoderReport{});
BENCHMARK_CAPTURE(decode_message, report, EncoderReport{});
BENCHMARK_CAPTURE(encode_message, force, ForceSample{});
BENCHMARK_CAPTURE(decode_message, force, ForceSample{});

void encode_edges(benchmark::State& state) {
  encode_message(state, sample_edges(static_cast<std::size_t>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
void decode_edges(benchmark::State& state) {
  decode_message(state, sample_edges(static_cast<std::size_t>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(encode_edges)->Arg(0)->Arg(27)->Arg(265)->Arg(1024);
BENCHMARK(decode_edges)->Arg(0)->Arg(27)->Arg(265)->Arg(1024);

void checksum(benchmark::State& state) {
  std::array<std::byte, kMaxPayloadSize> bytes{};
  const auto part =
      std::span<const std::byte>(bytes).first(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(crc32c(part));
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(checksum)->Arg(16)->Arg(128)->Arg(1085)->Arg(4121);

// Message -> frame -> message, as a link does it.
template <typename Framing, typename StreamReader>
void frame_round_trip(benchmark::State& state) {
  const auto edges = sample_edges(static_cast<std::size_t>(state.range(0)));
  std::array<std::byte, Framing::kMaxFrameSize> bytes;
  StreamReader reader;
  LastSink sink;
  for (auto _ : state) {
    const std::size_t size = Framing::append(edges, bytes);
    reader.feed(std::span<const std::byte>(bytes).first(size), sink);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(frame_round_trip<LengthFraming, FrameReader>)->Arg(0)->Arg(27)->Arg(265)->Arg(1024);
BENCHMARK(frame_round_trip<CobsFraming, CobsReader>)->Arg(0)->Arg(27)->Arg(265)->Arg(1024);

}  // namespace
}  // namespace towbench::protocol
