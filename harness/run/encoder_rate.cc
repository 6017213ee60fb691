#include "harness/run/encoder_rate.h"

#include <array>

#include <fmt/format.h>

#include "harness/link/in_process_plant.h"
#include "harness/link/unrecorded_plant.h"
#include "harness/link/witnessed_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"

namespace towbench::harness {
namespace {

// Edges of each exchange, and the most of them.
struct EdgeCounter final : protocol::MessageSink {
  using MessageSink::on;
  void on(const protocol::EncoderEdges& edges) noexcept override { now += edges.edges.size(); }
  void on(const protocol::Advanced& advanced) noexcept override {
    if (now > peak.edges) {
      peak.edges = now;
      peak.at_ns = advanced.time_ns;
    }
    now = 0;
  }
  std::size_t now = 0;
  EdgePeak peak;
};

struct Unwritten final : BenchRecorder {
  void drain(bbmc::ControllerNode& controller) noexcept override {
    bbmc::TelemetryRow row;
    while (controller.next_row(row)) {
    }
    bbmc::ControllerEvent event;
    while (controller.next_event(event)) {
    }
  }
  void console(std::string_view /*text*/) noexcept override {}
  void wire_event(core::Nanoseconds /*time_ns*/, std::string_view /*kind*/) noexcept override {}
  void timing(core::Nanoseconds /*time_ns*/, core::Nanoseconds /*host_ns*/,
              core::Nanoseconds /*exchange_ns*/) noexcept override {}
  void flush() noexcept override {}
  [[nodiscard]] std::uint64_t rows() const noexcept override { return 0; }
  [[nodiscard]] bool good() const noexcept override { return true; }
};

// One step of the quadrature of an axis, on its two lines.
core::Status step(protocol::EdgeDriver& driver, unsigned phase) noexcept {
  struct Toggle {
    protocol::EncoderLine line;
    bool level;
  };
  constexpr std::array<Toggle, 4> kToggles{{{protocol::EncoderLine::kA, true},
                                            {protocol::EncoderLine::kB, true},
                                            {protocol::EncoderLine::kA, false},
                                            {protocol::EncoderLine::kB, false}}};
  const Toggle& toggle = kToggles[phase % kToggles.size()];
  return driver.set(protocol::place_of(core::kFirstAxis, toggle.line), toggle.level);
}

// Edges that came within `patience_ns`, or fewer.
std::size_t await(protocol::EdgeReader& reader, std::size_t wanted, core::Nanoseconds patience_ns) {
  std::size_t come = 0;
  const auto asked_ns = reader.now_ns();
  while (come < wanted && reader.now_ns() - asked_ns < patience_ns) {
    const auto edges = reader.read();
    if (!edges) {
      return come;
    }
    come += edges->size();
  }
  return come;
}

}  // namespace

double EdgePeak::edges_per_s() const noexcept {
  return exchange_ns > 0 ? static_cast<double>(edges) / core::seconds(exchange_ns) : 0.0;
}

EdgePeak rehearse_edges(const ExperimentFixture& fixture, std::uint64_t seed) {
  UnrecordedPlant unrecorded;
  InProcessPlant plant(fixture.rig.parameters, seed, fixture.experiment.events, unrecorded);
  EdgeCounter counter;
  WitnessedPlant heard(plant, counter);
  LockstepBench bench(fixture.controller.configuration, fixture.rig.hash, heard, nullptr);
  Unwritten recorder;
  const auto outcome = play(fixture.experiment, bench, recorder, {});
  counter.peak.exchange_ns = outcome.exchange_ns;
  return counter.peak;
}

std::optional<double> measure_edges_per_s(protocol::EdgeDriver& driver,
                                          protocol::EdgeReader& reader) {
  constexpr unsigned kBursts = 20;
  constexpr unsigned kBurst = 100;  // whole turns of the quadrature: the lines end as they began
  for (unsigned place = 0; place < protocol::kEncoderChannels; ++place) {
    if (!driver.set(place, false)) {
      return std::nullopt;
    }
  }
  if (!reader.read()) {  // what came of that
    return std::nullopt;
  }
  const auto start_ns = reader.now_ns();
  for (unsigned burst = 0; burst < kBursts; ++burst) {
    for (unsigned phase = 0; phase < kBurst; ++phase) {
      if (!step(driver, phase)) {
        return std::nullopt;
      }
    }
    if (await(reader, kBurst, core::kNanosecondsPerSecond) != kBurst) {
      return std::nullopt;
    }
  }
  const auto took_ns = reader.now_ns() - start_ns;
  return took_ns > 0 ? std::optional(kBursts * kBurst / core::seconds(took_ns)) : std::nullopt;
}

protocol::CarrierResult<void> accept_edges(const EdgePeak& peak, const EdgeCapacity& capacity) {
  const double exchange_ms = core::seconds(peak.exchange_ns) * 1e3;
  const auto fastest =
      fmt::format("{:.0f} edges/s at its fastest ({} in the {:g} ms up to {:.3f} s)",
                  peak.edges_per_s(), peak.edges, exchange_ms, core::seconds(peak.at_ns));
  const auto refuse = [](std::string text) {
    return protocol::carrier_failure(core::ErrorCode::kCarrierOverloaded, std::move(text));
  };
  if (capacity.edges_per_s > 0 && peak.edges_per_s() > capacity.edges_per_s) {
    return refuse(fmt::format("{}; the lines carry {:.0f} edges/s ({})", fastest,
                              capacity.edges_per_s, capacity.source));
  }
  if (static_cast<double>(peak.edges) > kMaxEdgeLoad * protocol::kEdgeQueue) {
    return refuse(
        fmt::format("{}; the kernel keeps {} edges, of which {:.0f} may be used, between "
                    "two exchanges: {:.0f} edges/s",
                    fastest, protocol::kEdgeQueue, kMaxEdgeLoad * protocol::kEdgeQueue,
                    kMaxEdgeLoad * protocol::kEdgeQueue / core::seconds(peak.exchange_ns)));
  }
  return {};
}

}  // namespace towbench::harness
