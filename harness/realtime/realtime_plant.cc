#include "harness/realtime/realtime_plant.h"

#include "emulator/truth_row.h"
#include "harness/realtime/report_thinner.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {
namespace {

// Lets a controller do to the plant all but run its clock.
struct Gate final : protocol::EachMessage<Gate> {
  explicit Gate(protocol::MessageSink& plant) noexcept : to(plant) {}
  template <typename Message>
  void handle(const Message& message) noexcept {
    heard = true;
    to.on(message);
  }
  void handle(const protocol::Advance& /*advance*/) noexcept { heard = true; }
  void handle(const protocol::Hello& /*hello*/) noexcept { heard = true; }

  protocol::MessageSink& to;
  bool heard = false;
};

// From the wire to the plant, and back.
class Path {
 public:
  Path(emulator::PlantNode& plant, protocol::TurnLink& link, const PlantSurroundings& around)
      : witnessed_(around.witness != nullptr ? *around.witness : nobody_, plant),
        wired_(plant, witnessed_, link.peer(), around.wires, EdgeTimes::kOfKernel),
        thinner_(wired_.from_plant(), around.report_ns) {
    plant.connect(thinner_);
  }
  [[nodiscard]] protocol::MessageSink& to_plant() noexcept { return wired_.from_controller(); }
  [[nodiscard]] core::ErrorCode lost_line() const noexcept {
    const auto status = wired_.status();
    return status ? core::ErrorCode::kNone : status.error();
  }

 private:
  struct Nobody final : protocol::MessageSink {};
  Nobody nobody_;
  protocol::TeeSink witnessed_;
  WiredPath wired_;
  ReportThinner thinner_;
};

}  // namespace

core::Status serve_plant_in_real_time(emulator::PlantNode& plant, protocol::TurnLink& link,
                                      const protocol::Hello& hello, TickLoop& loop,
                                      const PlantSurroundings& around) {
  Path path(plant, link, around);
  path.to_plant().on(hello);
  Gate gate(path.to_plant());
  core::Nanoseconds now_ns = 0;
  core::Nanoseconds heard_ns = 0;
  loop.start();
  while (!plant.finished()) {
    loop.wait();
    gate.heard = false;
    auto lost = path.lost_line();
    if (const auto status = link.listen(gate, 0); !status) {
      lost = status.error();
    }
    heard_ns = gate.heard ? now_ns : heard_ns;
    if (now_ns - heard_ns > kRealtimeSilence_ns) {
      lost = core::ErrorCode::kPeerSilent;
    }
    if (plant.finished()) {
      break;  // a Bye, and what came behind it
    }
    if (lost != core::ErrorCode::kNone) {
      plant.peer_lost(lost);
      loop.end_tick();
      return core::failure(lost);
    }
    now_ns += core::kPlantTick_ns;
    path.to_plant().on(protocol::Advance{.until_ns = now_ns});
  }
  loop.end_tick();
  return {};
}

void ThinnedTruth::on_truth(const emulator::TruthRow& row) noexcept {
  if (exchange_ns_ <= 0 || row.time_ns % exchange_ns_ == 0) {
    PlantRelay::on_truth(row);
  }
}

core::Status RealtimePlantEnd::wait_for(protocol::Turn expected) noexcept {
  const bool is_running = expected == protocol::Turn::kAdvanced && to_plant_.until_ns > 0;
  if (!is_running) {
    loop_.end_tick();  // what follows is no part of the loop
    const auto status = link_.wait_for(expected, to_controller_);
    if (status && expected == protocol::Turn::kAdvanced) {
      to_controller_.to->on(protocol::Advanced{.time_ns = 0});
      loop_.start();
    }
    return status;
  }
  loop_.wait();
  to_controller_.heard = false;
  if (const auto status = link_.listen(to_controller_, 0); !status) {
    return core::failure(status.error());
  }
  if (to_controller_.ended) {
    return core::failure(core::ErrorCode::kPeerClosed);
  }
  last_heard_ns_ = to_controller_.heard ? to_plant_.until_ns : last_heard_ns_;
  if (to_plant_.until_ns - last_heard_ns_ > kRealtimeSilence_ns) {
    return core::failure(core::ErrorCode::kPeerSilent);
  }
  to_controller_.to->on(protocol::Advanced{.time_ns = to_plant_.until_ns});
  return {};
}

}  // namespace towbench::harness
