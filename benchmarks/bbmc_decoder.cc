// Time per encoder edge in the controller's quadrature decoder, and per read of its registers.
#include <cstdint>

#include <benchmark/benchmark.h>

#include "bbmc/host/quadrature_decoder.h"
#include "protocol/messages.h"

namespace {

using namespace towbench;

// One millisecond of steady motion with `edges` edges of A and B in turn.
protocol::EncoderEdges steady(std::int64_t edges) {
  protocol::EncoderEdges message;
  message.end_ns = core::kNanosecondsPerMillisecond;
  const auto step_ns = static_cast<std::uint32_t>(core::kNanosecondsPerMillisecond / (edges + 1));
  for (std::int64_t i = 0; i < edges; ++i) {
    (void)message.edges.push_back(
        {step_ns, i % 2 == 0 ? protocol::EncoderLine::kA : protocol::EncoderLine::kB});
  }
  return message;
}

void decode(benchmark::State& state) {
  protocol::EncoderEdges message = steady(state.range(0));
  bbmc::QuadratureDecoder decoder;
  for (auto _ : state) {
    benchmark::DoNotOptimize(decoder.take(message));
    benchmark::DoNotOptimize(decoder.read());
    // The next millisecond; an even number of toggles of each line leaves the levels as they were.
    ++message.sequence;
    message.start_ns = message.end_ns;
    message.end_ns += core::kNanosecondsPerMillisecond;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
// At rest, and at 9, 91 and 600 mm/s on Y: edges per millisecond, a multiple of four each.
BENCHMARK(decode)->Arg(0)->Arg(4)->Arg(40)->Arg(268);

}  // namespace
