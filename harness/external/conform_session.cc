#include "harness/external/conform_session.h"

#include <algorithm>
#include <chrono>

#include "harness/external/arrival.h"
#include "harness/external/reference_message.h"

namespace towbench::harness {
namespace {

// Half a minute of steady motion: what is to be seen happens within it.
std::vector<ReferenceMotion> slow_way() {
  return {{.kind = ReferenceKind::kTrapezoid,
           .axis = core::kFirstAxis,
           .at_s = 0.1,
           .distance_m = 3.0,
           .speed_m_per_s = 0.1,
           .acceleration_m_per_s2 = 0.5}};
}

}  // namespace

ConformSession::ConformSession(const std::string& command, const emulator::RigParameters& rig,
                               const std::filesystem::path& printed)
    : rig_(rig), reference_(slow_way()), node_(rig, 1, {}, watch_) {
  node_.connect(to_controller_);
  const auto path = folder_.path() / "bench";
  auto server = protocol::LocalServer::listen(path);
  if (server) {
    server_ = std::move(*server);
    process_.emplace(with_address(command, "local:" + path.string()), printed);
  }
}

ConformSession::~ConformSession() = default;

std::string ConformSession::greet(core::ErrorCode refusal) {
  to_controller_.refusal = refusal;
  const auto deadline = std::chrono::steady_clock::now() + kProcessComes;
  const auto goes_on = [&] {
    return std::chrono::steady_clock::now() < deadline && process_->runs();
  };
  if (!server_) {
    return "the bench cannot listen";
  }
  std::unique_ptr<protocol::LocalSocket> socket;
  while (!socket && goes_on()) {
    auto accepted = server_->accept(core::kNanosecondsPerSecond / 10);
    if (accepted) {
      socket = std::move(*accepted);
    }
  }
  if (!socket) {
    return "no controller came";
  }
  socket_ = socket.get();
  connection_ = protocol::Connection::over(std::move(socket));
  const auto hello = connection_->await_hello(goes_on);
  if (!hello) {
    return "no controller greeted";
  }
  hello_ = *hello;
  to_plant_.on(hello_);
  return {};
}

bool ConformSession::turn() {
  const auto turn = connection_->link().wait(to_plant_);
  return turn && *turn != protocol::Turn::kBye;
}

bool ConformSession::run_to(double time_s) {
  while (now_s() < time_s) {
    if (!turn()) {
      return false;
    }
  }
  return true;
}

void ConformSession::press_kill_switch() {
  node_.add_event(
      {.time_ns = node_.now_ns(), .kind = emulator::ScheduledEventKind::kPressKillSwitch});
}

void ConformSession::say_bye() {
  connection_->link().peer().on(protocol::Bye{node_.now_ns()});
}

std::optional<std::string> ConformSession::ended() {
  auto how = process_->join();
  if (how.starts_with("did not end")) {
    return std::nullopt;
  }
  return how;
}

double ConformSession::now_s() const {
  return core::seconds(node_.now_ns());
}

bool ConformSession::drives() const noexcept {
  const auto& driven = to_plant_.driven;
  return std::find(driven.begin(), driven.end(), true) != driven.end();
}

std::uint64_t ConformSession::refused() const {
  return watch_.refused + connection_->link().counts().errors();
}

void ConformSession::Watch::on_event(const emulator::PlantEvent& event) noexcept {
  refused += event.kind == emulator::PlantEventKind::kFault ? 1U : 0U;
}

// ---- controller to plant ----

void ConformSession::ToPlant::note(const protocol::PwmDuty& duty) noexcept {
  ++heard;
  driven[duty.axis] = duty.enable && duty.channel_a_ticks != duty.channel_b_ticks;
  has_driven = has_driven || driven[duty.axis];
}

void ConformSession::ToPlant::note(const protocol::Advance& advance) noexcept {
  ++heard;
  const auto now_ns = session.node_.now_ns();
  // The first one asks for the inputs of the beginning.
  const bool first = now_ns == 0 && advance.until_ns == 0;
  odd_turns += first || advance.until_ns == now_ns + session.hello_.exchange_ns ? 0U : 1U;
}

void ConformSession::ToPlant::note(const protocol::Fault& /*fault*/) noexcept {
  ++heard;
  complained = true;
}

void ConformSession::ToPlant::note(const protocol::Bye& /*bye*/) noexcept {
  ++heard;
  complained = true;
}

// ---- plant to controller ----

void ConformSession::ToController::handle(const protocol::HelloReply& reply) noexcept {
  auto ours = reply;
  ours.plant.capabilities |= protocol::kCapabilityReference;
  if (refusal != core::ErrorCode::kNone) {
    ours.refusal = refusal;
  }
  refusal = ours.refusal;
  session.connection_->link().peer().on(ours);
}

void ConformSession::ToController::handle(const protocol::EncoderReport& report) noexcept {
  if (loses_count && report.axis == core::kFirstAxis) {
    loses_count = false;
    return;
  }
  session.connection_->link().peer().on(report);
}

void ConformSession::ToController::handle(const protocol::EncoderEdges& edges) noexcept {
  if (loses_count && edges.axis == core::kFirstAxis) {
    loses_count = false;
    return;
  }
  session.connection_->link().peer().on(edges);
}

void ConformSession::ToController::handle(const protocol::AbsoluteCount& count) noexcept {
  if (!loses_absolute) {
    session.connection_->link().peer().on(count);
  }
}

void ConformSession::ToController::handle(const protocol::Advanced& advanced) noexcept {
  auto& peer = session.connection_->link().peer();
  if ((session.hello_.capabilities & protocol::kCapabilityReference) != 0) {
    for (const auto axis : core::kAllAxes) {
      if (session.rig_.axes[axis].exists) {
        peer.on(reference_message(session.reference_, axis, advanced.time_ns));
      }
    }
  }
  peer.on(advanced);
}

}  // namespace towbench::harness
