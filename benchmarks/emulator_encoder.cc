// Time per encoder edge: steady motion at several speeds, and the imperfect grating; beside them
// the memory-copy limit of the same bytes.
#include <algorithm>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include "emulator/edge_stream.h"
#include "emulator/sensors/quadrature_encoder.h"
#include "protocol/message_sink.h"

namespace {

using namespace towbench;

constexpr double kCountsPerRad = 4000.0 / (2.0 * std::numbers::pi);

// Accelerates a little, as a motor does, so that no two steps are alike.
class Motion {
 public:
  explicit Motion(double counts_per_s) : rate_(counts_per_s) {}
  const emulator::MotionSegments& next() {
    const double change = (turns_++ & 1U) != 0 ? 2.0 : -2.0;
    const double end_rate = rate_ + change;
    const double end = at_ + 0.5 * (rate_ + end_rate) * core::kPlantTick_s;
    segments_.clear();
    (void)segments_.push_back({0.0, core::kPlantTick_s, at_ / kCountsPerRad, rate_ / kCountsPerRad,
                               end / kCountsPerRad, end_rate / kCountsPerRad});
    at_ = end;
    rate_ = end_rate;
    return segments_;
  }

 private:
  emulator::MotionSegments segments_;
  double at_ = 0.3;
  double rate_;
  unsigned turns_ = 0;
};

void run(benchmark::State& state, const emulator::EncoderParameters& parameters) {
  Motion motion(static_cast<double>(state.range(0)));
  emulator::QuadratureEncoder encoder(parameters, 0.0);
  emulator::StepEdges edges;
  std::int64_t total = 0;
  for (auto _ : state) {
    encoder.step(motion.next(), edges);
    benchmark::DoNotOptimize(edges);
    total += static_cast<std::int64_t>(edges.size());
  }
  state.SetItemsProcessed(total);
  state.counters["ns_per_edge"] = benchmark::Counter(
      static_cast<double>(total) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void ideal_grating(benchmark::State& state) {
  run(state, {});
}
void imperfect_grating(benchmark::State& state) {
  run(state, {.phase_deg = 70.0});
}
BENCHMARK(ideal_grating)->Arg(250'000)->Arg(100'000)->Arg(10'000)->Arg(0);
BENCHMARK(imperfect_grating)->Arg(250'000);

void edges_into_messages(benchmark::State& state) {
  struct Sink : protocol::MessageSink {
    using MessageSink::on;
    void on(const protocol::EncoderEdges& m) noexcept override { benchmark::DoNotOptimize(m); }
  } sink;
  Motion motion(250e3);
  emulator::QuadratureEncoder encoder({}, 0.0);
  emulator::EdgeStream stream(core::Axis::kY, encoder.levels());
  emulator::StepEdges edges;
  std::int64_t total = 0;
  core::Nanoseconds now = 0;
  for (auto _ : state) {
    stream.begin(now);
    for (int i = 0; i < 10; ++i) {
      encoder.step(motion.next(), edges);
      stream.add(now, edges, sink);
      now += core::kPlantTick_ns;
      total += static_cast<std::int64_t>(edges.size());
    }
    stream.finish(now, sink);
  }
  state.SetItemsProcessed(total);
  state.counters["ns_per_edge"] = benchmark::Counter(
      static_cast<double>(total) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(edges_into_messages);

// The memory-copy limit: the same bytes an edge, already known, copied. 250 edges stay in the first
// cache, as those of an exchange do; 16 million (64 MB) go through memory.
void copy_limit(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const std::vector<protocol::EncoderEdge> from(size);
  std::vector<protocol::EncoderEdge> to(size);
  static_assert(sizeof(protocol::EncoderEdge) == sizeof(emulator::TimedEdge));
  std::int64_t total = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(from.data());
    std::copy(from.begin(), from.end(), to.begin());
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
    total += state.range(0);
  }
  state.counters["ns_per_edge"] = benchmark::Counter(
      static_cast<double>(total) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(copy_limit)->Arg(250)->Arg(16'000'000);

}  // namespace
