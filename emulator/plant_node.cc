#include "emulator/plant_node.h"

#include "emulator/plant_exchange.h"

namespace towbench::emulator {

class PlantNode::Implementation : public PlantExchange {
 public:
  using PlantExchange::PlantExchange;
};

PlantNode::PlantNode(const RigParameters& rig, std::uint64_t seed,
                     std::span<const ScheduledEvent> events, PlantObserver& observer)
    : implementation_(std::make_unique<Implementation>(rig, seed, events, observer)) {}
PlantNode::~PlantNode() = default;

void PlantNode::connect(protocol::MessageSink& controller) noexcept {
  implementation_->connect(controller);
}

void PlantNode::on(const protocol::Hello& hello) noexcept {
  implementation_->greet(hello);
}
void PlantNode::on(const protocol::PwmDuty& duty) noexcept {
  implementation_->drive(duty);
}
void PlantNode::on(const protocol::DigitalOutputs& outputs) noexcept {
  implementation_->set_outputs(outputs);
}
void PlantNode::on(const protocol::Advance& advance) noexcept {
  implementation_->advance(advance);
}
void PlantNode::on(const protocol::Fault& fault) noexcept {
  implementation_->note_fault(fault);
}
void PlantNode::on(const protocol::Bye& bye) noexcept {
  implementation_->end(bye);
}

void PlantNode::add_event(const ScheduledEvent& event) {
  implementation_->add_event(event);
}
void PlantNode::peer_lost(core::ErrorCode why) noexcept {
  implementation_->peer_lost(why);
}
bool PlantNode::finished() const noexcept {
  return implementation_->finished();
}
const std::string& PlantNode::failure() const noexcept {
  return implementation_->failure();
}
core::Nanoseconds PlantNode::now_ns() const noexcept {
  return implementation_->now_ns();
}

protocol::EncoderLevels PlantNode::encoder_levels(core::Axis axis) const noexcept {
  return implementation_->encoder_levels(axis);
}

}  // namespace towbench::emulator
