// Whether encoder lines carry what an experiment will send over them; asked before the run.
//
// Two bounds. The kernel keeps so many edges between two exchanges and throws away the oldest
// (edge_port.h); and a line costs an interrupt an edge, so that it carries only so many a second:
// what the user rated it for or, by the wall clock, what was measured on it a moment ago. In
// lockstep time waits for the lines and only a rating bounds them.
#pragma once

#include <optional>

#include "harness/experiment/experiment_fixture.h"
#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/edge_port.h"

namespace towbench::harness {

// The busiest exchange of a run, both axes together.
struct EdgePeak {
  std::size_t edges = 0;  // A, B and index
  core::Nanoseconds exchange_ns = 0;
  core::Nanoseconds at_ns = 0;  // its end

  [[nodiscard]] double edges_per_s() const noexcept;
};

// Plays the experiment in this process, without a record. Takes as long as an in-process run does.
[[nodiscard]] EdgePeak rehearse_edges(const ExperimentFixture& fixture, std::uint64_t seed);

// How many edges a second get through, driven in bursts and read; every line is left as it was.
// nullopt when not all came.
[[nodiscard]] std::optional<double> measure_edges_per_s(protocol::EdgeDriver& driver,
                                                        protocol::EdgeReader& reader);

struct EdgeCapacity {
  double edges_per_s = 0;   // 0: no bound
  const char* source = "";  // "rated", "measured"
};

// Share of the kernel's queue, and of a measured rate, that a run may use.
inline constexpr double kMaxEdgeLoad = 0.8;

// kCarrierOverloaded with both figures.
[[nodiscard]] protocol::CarrierResult<void> accept_edges(const EdgePeak& peak,
                                                         const EdgeCapacity& capacity);

}  // namespace towbench::harness
