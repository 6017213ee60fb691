// A lockstep exchange over the local socket against a bare ping-pong of the same bytes on the same
// kind of socket, between two processes on one core, and on as many as there are.
#include <array>
#include <cstdlib>

#include <benchmark/benchmark.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/protocol_samples.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"

namespace towbench::protocol {
namespace {

void pin_to(std::int64_t cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (std::size_t core = 0; core < static_cast<std::size_t>(cores); ++core) {
    CPU_SET(core, &set);
  }
  sched_setaffinity(0, sizeof(set), &set);
}

// Answers as a plant does: edges of both axes, then Advanced.
class AnsweringPlant final : public MessageSink {
 public:
  AnsweringPlant(MessageSink& controller, std::size_t edges)
      : controller_(controller), y_(sample_edges(edges)), x_(sample_edges(edges)) {
    x_.axis = core::Axis::kX;
  }
  using MessageSink::on;
  void on(const Advance& advance) noexcept override {
    controller_.on(y_);
    controller_.on(x_);
    controller_.on(Advanced{advance.until_ns});
  }

 private:
  MessageSink& controller_;
  EncoderEdges y_;
  EncoderEdges x_;
};

void lockstep_exchange(benchmark::State& state) {
  const auto edges = static_cast<std::size_t>(state.range(0));
  pin_to(state.range(1));
  auto ends = LocalSocket::pair();
  const pid_t child = fork();
  if (child == 0) {
    ends->first.reset();
    LockstepLink link(*ends->second);
    AnsweringPlant plant(link.peer(), edges);
    while (link.wait(plant).has_value()) {
    }
    std::_Exit(0);
  }
  ends->second.reset();
  {
    LockstepLink link(*ends->first);
    class Ignore final : public MessageSink {
    } controller;
    core::Nanoseconds now_ns = 0;
    for (auto _ : state) {
      link.peer().on(sample_duty());
      link.peer().on(sample_duty());
      now_ns += core::kNanosecondsPerMillisecond;
      link.peer().on(Advance{now_ns});
      if (!link.wait_for(Turn::kAdvanced, controller).has_value()) {
        state.SkipWithError("peer lost");
        break;
      }
    }
    const auto turns = static_cast<double>(state.iterations());
    state.counters["bytes_out"] = static_cast<double>(link.bytes_sent()) / turns;
    state.counters["bytes_in"] = static_cast<double>(link.bytes_received()) / turns;
    ends->first.reset();
  }
  waitpid(child, nullptr, 0);
}

void bare_ping_pong(benchmark::State& state) {
  const auto edges = static_cast<std::size_t>(state.range(0));
  const std::size_t out = 2 * (13 + 6) + 9 + 6;
  const std::size_t in = 2 * (kEdgesHeaderSize + 4 * edges + 6) + 9 + 6;
  pin_to(state.range(1));
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
    state.SkipWithError("no socket pair");
    return;
  }
  std::array<char, 65536> bytes{};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    while (recv(ends[1], bytes.data(), bytes.size(), 0) > 0) {
      if (send(ends[1], bytes.data(), in, MSG_NOSIGNAL) < 0) {
        break;
      }
    }
    std::_Exit(0);
  }
  close(ends[1]);
  for (auto _ : state) {
    if (send(ends[0], bytes.data(), out, MSG_NOSIGNAL) < 0 ||
        recv(ends[0], bytes.data(), bytes.size(), 0) <= 0) {
      state.SkipWithError("peer lost");
      break;
    }
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
}

void edges_and_cores(benchmark::internal::Benchmark* b) {
  for (const std::int64_t cores : {1, 2}) {
    for (const std::int64_t edges : {0, 27, 265}) {
      b->Args({edges, cores});
    }
  }
  b->UseRealTime();
}

BENCHMARK(bare_ping_pong)->Apply(edges_and_cores);
BENCHMARK(lockstep_exchange)->Apply(edges_and_cores);

}  // namespace
}  // namespace towbench::protocol
