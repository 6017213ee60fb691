#include "harness/run/child_runner.h"

#include <memory>

#include <fmt/format.h>

#include "harness/link/linked_plant.h"
#include "harness/link/pty_line.h"
#include "harness/record/line_writer.h"
#include "harness/run/conversation.h"
#include "protocol/carriers/paced_can.h"

namespace towbench::harness {
namespace {

using protocol::Connection;

protocol::CarrierResult<std::unique_ptr<Connection>> connect(
    EmulatorProcess& child, const std::optional<protocol::CarrierEnds>& wire) {
  constexpr core::Nanoseconds kStartUp_ns = 10 * core::kNanosecondsPerSecond;
  if (wire) {
    return Connection::to_plant(wire->controller, kStartUp_ns);
  }
  auto connection = Connection::over(child.take_stream());
  // A child that died shows in the handshake.
  (void)connection->await_heartbeat(kStartUp_ns);
  return connection;
}

// What a run has put on its wire, for whoever compares carriers.
void write_wire_use(const std::filesystem::path& folder, const protocol::WireUse& use) {
  write_atomically(folder / "wire.json",
                   fmt::format("{{\n \"bits_to_controller\": {},\n \"bits_to_plant\": {}\n}}\n",
                               use.bits_received, use.bits_sent));
}

RunOutcome incomplete_because(const std::string& reason) {
  RunOutcome outcome;
  outcome.reason = reason;
  return outcome;
}

}  // namespace

RunOutcome ChildRunner::play() {
  Wire wire = plan().options.wire;
  std::optional<PtyLine> line;
  if (plan().options.carrier == Carrier::kSerialPty) {
    line.emplace();
    wire = *protocol::parse_carrier_ends("serial:" + line->near_end() + ',' + line->far_end());
  }
  const auto child = start_child(wire);
  auto outcome = play_with(*child, wire);
  if (const auto trouble = child->join(); !trouble.empty()) {
    outcome.reason += (outcome.reason.empty() ? "" : "; ") + trouble;
    outcome.complete = false;
  }
  return outcome;
}

std::vector<std::string> ChildRunner::arguments() const {
  const auto& options = plan().options;
  std::vector<std::string> words{(plan().folder / plan().identity.experiment_copy).string(),
                                 "--seed", std::to_string(plan().seed), "--out",
                                 plan().folder.string()};
  if (!options.lines.plant.empty()) {
    words.insert(words.end(), {"--lines", options.lines.plant});
  }
  if (!options.encoder_lines.plant.empty()) {
    words.insert(words.end(), {"--encoder-lines", options.encoder_lines.plant});
  }
  if (options.clock == RunClock::kReal) {
    words.insert(words.end(), {"--clock", "real"});
  }
  return words;
}

std::unique_ptr<EmulatorProcess> ChildRunner::start_child(const Wire& wire) const {
  const auto& options = plan().options;
  // What it has to say of such an end is in its record.
  const bool end_is_expected = plan().may_end_early() || plan().kind == RunKind::kKilledHost;
  return options.carrier == Carrier::kLocal
             ? EmulatorProcess::with_socket(options.program, arguments(), end_is_expected)
             : EmulatorProcess::on_wire(options.program, arguments(), wire->plant.text(),
                                        end_is_expected);
}

RunOutcome ChildRunner::play_with(EmulatorProcess& child, const Wire& wire) {
  const auto connection = connect(child, wire);
  if (!connection) {
    return incomplete_because(connection.error().message);
  }
  std::unique_ptr<CanLog> log;
  if (auto* can = (*connection)->can_link(); can != nullptr) {
    log = std::make_unique<CanLog>(plan().folder / "candump.log",
                                   protocol::named_bus(wire->controller.place)->interface);
    can->log_to(*log);
  }
  auto outcome = play_over(child, **connection, log.get());
  write_wire_use(plan().folder, (*connection)->wire_use());
  if (log != nullptr) {
    log->flush();
    outcome.writes_succeeded = outcome.writes_succeeded && log->good();
  }
  return outcome;
}

RunOutcome ChildRunner::with_lines(PlantEnd& plant, EdgeTimes times,
                                   const std::function<RunOutcome(PlantEnd&)>& conversation) const {
  const auto& options = plan().options;
  const auto wired =
      WiredPlant::open(plant, {options.lines.controller, options.encoder_lines.controller}, times);
  if (!wired) {
    return incomplete_because(wired.error().message);
  }
  return conversation((*wired)->whole());
}

RunOutcome LockstepChildRunner::play_over(EmulatorProcess& child, Connection& connection,
                                          CanLog* /*log*/) {
  LinkedPlant plant(connection.link());
  return with_lines(plant, EdgeTimes::kOfExchange,
                    [&](PlantEnd& whole) { return converse(plan(), whole, child); });
}

}  // namespace towbench::harness
