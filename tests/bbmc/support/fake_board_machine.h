// The emulated machine behind a fake board: reads what the controller wrote into the files, steps,
// and writes into them what the machine's sensors would say. Meets the controller nowhere else.
#pragma once

#include <vector>

#include "emulator/plant_node.h"
#include "emulator/rig_parameters.h"
#include "protocol/message_sink.h"
#include "tests/bbmc/support/fake_board.h"

namespace towbench::tests {

class FakeBoardMachine final : public protocol::MessageSink, public emulator::PlantObserver {
 public:
  // The board outlives this.
  FakeBoardMachine(FakeBoard& board, const emulator::RigParameters& rig,
                   core::Nanoseconds exchange_ns);
  ~FakeBoardMachine() override = default;

  // One exchange of the machine.
  void step();
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept { return now_ns_; }
  void press_kill_switch() noexcept { kill_pressed_ = true; }

  std::vector<emulator::TruthRow> truth;
  bool touched_a_hard_end = false;

  using MessageSink::on;
  void on(const protocol::HelloReply& reply) noexcept override;
  void on(const protocol::DigitalInputs& inputs) noexcept override { inputs_ = inputs.lines; }
  void on_truth(const emulator::TruthRow& row) noexcept override { truth.push_back(row); }
  void on_event(const emulator::PlantEvent& event) noexcept override;

 private:
  void read_outputs();
  void write_inputs();

  FakeBoard& board_;
  emulator::PlantNode plant_;
  core::Nanoseconds exchange_ns_;
  core::Nanoseconds now_ns_ = 0;
  protocol::InputLines inputs_ = 0;
  std::uint32_t sequence_ = 0;
  bool kill_pressed_ = false;
};

}  // namespace towbench::tests
