// BBMC's system layer on the emulated board, wired to the emulated machine in lockstep, without the
// application layer: tests speak to the system manager as the application would.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bbmc/host/emulated_board.h"
#include "bbmc/system/system_manager.h"
#include "emulator/plant_node.h"
#include "protocol/message_sink.h"

namespace towbench::tests {

// Starts with both axes calibrated where the machine really stands.
class Machine final : public protocol::MessageSink, public emulator::PlantObserver {
 public:
  struct Options {
    bbmc::Configuration configuration;
    emulator::RigParameters rig;
    std::vector<emulator::ScheduledEvent> events;
    core::PerPlanarAxis<double> start_m{{1.0, 0.3}};
    bool calibrated = true;
  };

  Machine() : Machine(Options{}) {}
  explicit Machine(const Options& options);
  ~Machine() override = default;

  [[nodiscard]] bbmc::SystemManager& system() noexcept { return *system_; }
  [[nodiscard]] bbmc::EmulatedBoard& board() noexcept { return *board_; }
  [[nodiscard]] bbmc::DeviceManager& devices() noexcept { return *devices_; }
  [[nodiscard]] double time_s() const noexcept { return core::seconds(now_ns_); }
  [[nodiscard]] const bbmc::AxisStatus& status(core::Axis axis) const noexcept {
    return system_->status().axes[axis];
  }

  // One exchange; false when the plant did not answer.
  void exchange();
  void run_for(double duration_s);
  // Until at rest, for `limit_s` at most; whether it came to rest.
  bool run_until_rest(double limit_s);

  // Filled as it goes.
  std::vector<bbmc::TelemetryRow> rows;
  std::vector<bbmc::SystemEvent> events;
  std::vector<emulator::TruthRow> truth;
  std::vector<emulator::PlantEvent> plant_events;
  struct Duty {
    core::Nanoseconds time_ns;
    protocol::PwmDuty message;
  };
  std::vector<Duty> duties;

  // Changes what the encoder of an axis says, message by message, before the board takes it.
  std::function<void(protocol::EncoderEdges&)> disturb_edges;
  bool keep_records = true;

  [[nodiscard]] const bbmc::SystemEvent* find(bbmc::SystemEvent::Kind kind) const;

  // ---- MessageSink: what the plant sends ----
  using MessageSink::on;
  void on(const protocol::HelloReply& reply) noexcept override;
  void on(const protocol::EncoderEdges& edges) noexcept override;
  void on(const protocol::DigitalInputs& inputs) noexcept override;
  // ---- PlantObserver ----
  void on_truth(const emulator::TruthRow& row) noexcept override;
  void on_event(const emulator::PlantEvent& event) noexcept override;

 private:
  // Sees what the controller sends, then hands it to the plant.
  class Tap final : public protocol::MessageSink {
   public:
    explicit Tap(Machine& machine) : machine_(machine) {}
    using MessageSink::on;
    void on(const protocol::PwmDuty& duty) noexcept override;
    void on(const protocol::DigitalOutputs& outputs) noexcept override;

   private:
    Machine& machine_;
  };

  void serve();

  core::Nanoseconds exchange_ns_;
  core::Nanoseconds now_ns_ = 0;
  std::vector<bbmc::DataLogRow> log_storage_;
  std::unique_ptr<bbmc::EmulatedBoard> board_;
  std::unique_ptr<bbmc::DeviceManager> devices_;
  std::unique_ptr<bbmc::SystemManager> system_;
  std::unique_ptr<emulator::PlantNode> plant_;
  Tap tap_{*this};
};

}  // namespace towbench::tests
