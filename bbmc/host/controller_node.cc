#include "bbmc/host/controller_node.h"

#include "bbmc/application/application.h"
#include "bbmc/host/emulated_board.h"
#include "bbmc/host/guarded_rows.h"
#include "bbmc/system/system_manager.h"
#include "core/check.h"

namespace towbench::bbmc {

class ControllerNode::Implementation {
 public:
  Implementation(const Configuration& configuration, std::uint64_t fixture_hash)
      : hash(fixture_hash),
        axes_mask(mask_of_axes(configuration)),
        exchange_ns(exchange_period_ns(configuration.control_period_ns())),
        log_storage(kDataLogRows),
        devices(board.ports()),
        system(configuration, devices, log_storage.span()),
        application(system, devices) {
    core::check(inconsistency(configuration) == nullptr);
  }

  [[nodiscard]] static std::uint8_t mask_of_axes(const Configuration& configuration) noexcept {
    unsigned mask = 0;
    for (core::Axis axis : kAxes) {
      mask |= configuration.axes[axis].exists ? 1U << core::index_of(axis) : 0U;
    }
    return static_cast<std::uint8_t>(mask);
  }

  // A message that does not follow the one before means that motion was missed.
  void must_continue(bool continues) noexcept {
    if (!continues) {
      lose_link(core::ErrorCode::kFaultLinkCorrupt);
    }
  }

  void lose_link(core::ErrorCode why) noexcept {
    if (started) {
      system.link_lost(why);
      board.flush(*plant);
    }
  }

  std::uint64_t hash;
  std::uint8_t axes_mask;
  core::Nanoseconds exchange_ns;
  core::Nanoseconds plant_time_ns = 0;
  core::Status agreed = core::failure(core::ErrorCode::kPeerSilent);
  protocol::MessageSink* plant = nullptr;
  bool started = false;
  bool ended = false;
  EmulatedBoard board;
  GuardedRows<DataLogRow> log_storage;
  DeviceManager devices;
  SystemManager system;
  Application application;
};

ControllerNode::ControllerNode(const Configuration& configuration, std::uint64_t fixture_hash)
    : implementation_(std::make_unique<Implementation>(configuration, fixture_hash)) {}

ControllerNode::~ControllerNode() = default;

void ControllerNode::connect(protocol::MessageSink& plant) noexcept {
  implementation_->plant = &plant;
}

void ControllerNode::greet() noexcept {
  Implementation& self = *implementation_;
  core::check(self.plant != nullptr);
  self.plant->on(
      protocol::Hello{.version = protocol::kProtocolVersion,
                      .role = protocol::Role::kController,
                      .axes_mask = self.axes_mask,
                      .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                      .exchange_ns = static_cast<std::uint32_t>(self.exchange_ns),
                      .capabilities = protocol::kCapabilityEdges | protocol::kCapabilityDigest,
                      .fixture_hash = self.hash});
}

core::Status ControllerNode::handshake() const noexcept {
  return implementation_->agreed;
}

void ControllerNode::on(const protocol::HelloReply& reply) noexcept {
  Implementation& self = *implementation_;
  if (reply.refusal != core::ErrorCode::kNone) {
    self.agreed = core::failure(reply.refusal);
  } else if (reply.plant.version != protocol::kProtocolVersion) {
    self.agreed = core::failure(core::ErrorCode::kProtocolVersion);
  } else if (reply.plant.role != protocol::Role::kPlant) {
    self.agreed = core::failure(core::ErrorCode::kProtocolRole);
  } else if ((reply.plant.axes_mask & self.axes_mask) != self.axes_mask) {
    self.agreed = core::failure(core::ErrorCode::kProtocolAxes);
  } else {
    self.agreed = {};
  }
}

void ControllerNode::on(const protocol::EncoderEdges& edges) noexcept {
  implementation_->must_continue(implementation_->board.take(edges));
}

void ControllerNode::on(const protocol::EncoderReport& report) noexcept {
  implementation_->must_continue(implementation_->board.take(report));
}

void ControllerNode::on(const protocol::DigitalInputs& inputs) noexcept {
  implementation_->must_continue(implementation_->board.take(inputs));
}

void ControllerNode::on(const protocol::ForceSample& /*sample*/) noexcept {}
void ControllerNode::on(const protocol::CurrentSample& /*sample*/) noexcept {}

void ControllerNode::on(const protocol::Advanced& advanced) noexcept {
  implementation_->plant_time_ns = advanced.time_ns;
}

void ControllerNode::on(const protocol::Fault& fault) noexcept {
  // The plant tells what it found wrong for the record; what stops the machine are its lines.
  if (fault.code == core::ErrorCode::kSequence || fault.code == core::ErrorCode::kMessageBadField) {
    implementation_->lose_link(core::ErrorCode::kFaultLinkCorrupt);
  }
}

void ControllerNode::on(const protocol::Bye& /*bye*/) noexcept {
  if (!implementation_->ended) {
    peer_lost(core::ErrorCode::kPeerClosed);
  }
}

void ControllerNode::serve(core::Nanoseconds now_ns) noexcept {
  Implementation& self = *implementation_;
  self.board.set_time(now_ns);
  if (!self.started) {
    self.started = true;
    core::check(self.system.start().has_value());
  }
  self.system.service(now_ns);
  self.board.flush(*self.plant);
  self.application.poll(now_ns);
}

core::Nanoseconds ControllerNode::exchange_ns() const noexcept {
  return implementation_->exchange_ns;
}

core::Nanoseconds ControllerNode::plant_time_ns() const noexcept {
  return implementation_->plant_time_ns;
}

std::size_t ControllerNode::type(std::string_view bytes) noexcept {
  return implementation_->board.console().type(bytes);
}

std::size_t ControllerNode::read_console(std::span<char> into) noexcept {
  return implementation_->board.console().read_out(into);
}

bool ControllerNode::next_row(TelemetryRow& row) noexcept {
  return implementation_->system.next_row(row);
}

bool ControllerNode::next_event(ControllerEvent& event) noexcept {
  return implementation_->system.next_event(event);
}

std::uint64_t ControllerNode::rows_lost() const noexcept {
  return implementation_->system.rows_lost();
}

EdgeTimes ControllerNode::edge_times(core::Axis axis) const noexcept {
  return implementation_->board.decoder(axis).edge_times();
}

bool ControllerNode::idle() const noexcept {
  Implementation& self = *implementation_;
  return self.system.at_rest() && self.application.idle() && !self.board.console().has_input();
}

bool ControllerNode::quit_requested() const noexcept {
  return implementation_->application.quit_requested();
}

void ControllerNode::peer_lost(core::ErrorCode /*why*/) noexcept {
  implementation_->lose_link(core::ErrorCode::kFaultLinkLost);
}

void ControllerNode::say_bye() noexcept {
  Implementation& self = *implementation_;
  if (self.ended || self.plant == nullptr) {
    return;
  }
  self.ended = true;
  self.devices.close_all();  // outputs inactive
  self.board.flush(*self.plant);
  self.plant->on(protocol::Bye{.time_ns = self.plant_time_ns});
}

}  // namespace towbench::bbmc
