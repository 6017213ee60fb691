// controller_process ADDRESS LOG: the controller as a process of its own that meets the machine
// over a carrier and plays the console of fixtures/experiments/trapezoid-400.toml. Every figure of
// every tick goes to LOG, to the last bit. tools/armhf_duty.sh builds it for armhf and compares.
#include <cstdio>
#include <cstring>
#include <string_view>

#include "harness/link/linked_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "protocol/carriers/connection.h"

namespace {

using namespace towbench;

constexpr core::Nanoseconds kLimit_ns = 20 * core::kNanosecondsPerSecond;

// fixtures/controllers/bbmc-tuned.toml
bbmc::Configuration tuned() {
  bbmc::Configuration configuration;
  configuration.axes[core::Axis::kY].gains = {0.05, 0.5, 6e-4};
  configuration.axes[core::Axis::kX].gains = {0.02, 0.2, 2e-4};
  return configuration;
}

class BitRecorder final : public harness::BenchRecorder {
 public:
  explicit BitRecorder(std::FILE* file) : file_(file) {}
  void drain(bbmc::ControllerNode& controller) noexcept override {
    bbmc::TelemetryRow row;
    while (controller.next_row(row)) {
      std::fprintf(file_, "%lld %u", static_cast<long long>(row.time_ns),
                   unsigned{core::number_of(row.fault)});
      for (const auto& axis : row.axes) {
        std::fprintf(file_, " %d %lld %u %a %a %a %a", static_cast<int>(axis.mode),
                     static_cast<long long>(axis.count), axis.edges, axis.reference_m,
                     axis.reference_velocity_m_per_s, axis.velocity_m_per_s, axis.duty_pct);
      }
      std::fputc('\n', file_);
      ++rows_;
    }
    bbmc::ControllerEvent event;
    while (controller.next_event(event)) {
    }
  }
  void console(std::string_view text) noexcept override {
    std::fwrite(text.data(), 1, text.size(), stdout);
  }
  void wire_event(core::Nanoseconds /*time_ns*/, std::string_view /*kind*/) noexcept override {}
  void timing(core::Nanoseconds /*time_ns*/, core::Nanoseconds /*host_ns*/,
              core::Nanoseconds /*exchange_ns*/) noexcept override {}
  void flush() noexcept override {}
  [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_; }
  [[nodiscard]] bool good() const noexcept override { return std::ferror(file_) == 0; }

 private:
  std::FILE* file_;
  std::uint64_t rows_ = 0;
};

bool play(harness::LockstepBench& bench) {
  constexpr std::string_view kLines[] = {
      "reset poscalib y 0.449092m\r", "reset poscalib x 0.336819m\r",
      "run -trapez y --distance 2.4m --speed 0.4m/s --acceleration 0.8s\r"};
  if (!bench.start()) {
    return false;
  }
  (void)bench.serve();
  for (const std::string_view line : kLines) {
    (void)bench.controller().type(line);
    do {
      if (!bench.advance() || bench.now_ns() > kLimit_ns) {
        return false;
      }
      (void)bench.serve();
    } while (!bench.controller().idle());
  }
  bench.finish();
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* const log = argc == 3 ? std::fopen(argv[2], "w") : nullptr;
  const auto address = protocol::parse_carrier_address(argc == 3 ? argv[1] : "");
  if (log == nullptr || !address) {
    std::fputs("usage: controller_process ADDRESS LOG\n", stderr);
    return 2;
  }
  auto connection = protocol::Connection::to_plant(*address, 60 * core::kNanosecondsPerSecond);
  if (!connection) {
    std::fprintf(stderr, "%s\n", connection.error().message.c_str());
    return 3;
  }
  harness::LinkedPlant plant((*connection)->link());
  BitRecorder recorder(log);
  harness::LockstepBench bench(tuned(), 0, plant, &recorder);
  const bool complete = play(bench);
  const bool written = std::fclose(log) == 0;
  return complete && written ? 0 : 3;
}
