// record INPUTS DUTY: the controller against the emulated machine, every message of the machine
// written to INPUTS and every duty to DUTY, as text of whole numbers.
#include <cstdio>
#include <memory>
#include <vector>

#include "bbmc/host/emulated_board.h"
#include "emulator/plant_node.h"
#include "tests/bbmc/portable/duty_sink.h"
#include "tests/bbmc/portable/script.h"

namespace {

using namespace towbench;

class Recorder final : public protocol::MessageSink, public emulator::PlantObserver {
 public:
  explicit Recorder(bbmc::EmulatedBoard& board, std::FILE* file) : board_(board), file_(file) {}
  using MessageSink::on;
  void on(const protocol::HelloReply& /*reply*/) noexcept override {}
  void on(const protocol::EncoderEdges& edges) noexcept override {
    std::fprintf(file_, "E %d %d %lld %lld %u %zu", static_cast<int>(edges.axis),
                 static_cast<int>(edges.start_levels), static_cast<long long>(edges.start_ns),
                 static_cast<long long>(edges.end_ns), edges.sequence, edges.edges.size());
    for (const auto& edge : edges.edges) {
      std::fprintf(file_, " %u", edge.packed());
    }
    std::fputc('\n', file_);
    core::check(board_.take(edges));
  }
  void on(const protocol::DigitalInputs& inputs) noexcept override {
    std::fprintf(file_, "D %u %lld %u\n", static_cast<unsigned>(inputs.lines),
                 static_cast<long long>(inputs.change_ns), inputs.sequence);
    core::check(board_.take(inputs));
  }
  void on_truth(const emulator::TruthRow& /*row*/) noexcept override {}
  void on_event(const emulator::PlantEvent& /*event*/) noexcept override {}

 private:
  bbmc::EmulatedBoard& board_;
  std::FILE* file_;
};

}  // namespace

int main(int argc, char** argv) {
  std::FILE* const inputs = argc == 3 ? std::fopen(argv[1], "w") : nullptr;
  std::FILE* const duty = argc == 3 ? std::fopen(argv[2], "w") : nullptr;
  if (inputs == nullptr || duty == nullptr) {
    std::fputs("usage: bbmc_record INPUTS DUTY\n", stderr);
    return 2;
  }
  const auto board = std::make_unique<bbmc::EmulatedBoard>();
  bbmc::DeviceManager devices(board->ports());
  std::vector<bbmc::DataLogRow> log(bbmc::kDataLogRows);
  const auto system =
      std::make_unique<bbmc::SystemManager>(portable::configuration(), devices, log);
  emulator::RigParameters rig;
  for (const core::Axis axis : core::kPlanarAxes) {
    rig.axes[axis].start_m = portable::kStart_m[axis];
  }
  Recorder recorder(*board, inputs);
  emulator::PlantNode plant(rig, 1, {}, recorder);
  portable::DutySink sink(duty, &plant);
  plant.connect(recorder);
  plant.on(protocol::Hello{.axes_mask = 3,
                           .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                           .exchange_ns = 1'000'000,
                           .capabilities = protocol::kCapabilityEdges});
  if (!system->start()) {
    return 1;
  }
  for (long exchange = 0; exchange < portable::kExchanges; ++exchange) {
    const core::Nanoseconds now_ns = exchange * core::kNanosecondsPerMillisecond;
    if (exchange > 0) {
      plant.on(protocol::Advance{now_ns});
    }
    std::fprintf(inputs, "S %lld\n", static_cast<long long>(now_ns));
    if (!portable::serve(*board, *system, exchange, sink)) {
      std::fprintf(stderr, "refused at exchange %ld\n", exchange);
      return 1;
    }
  }
  return std::fclose(inputs) == 0 && std::fclose(duty) == 0 ? 0 : 1;
}
