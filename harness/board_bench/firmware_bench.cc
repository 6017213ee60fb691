#include "harness/board_bench/firmware_bench.h"

#include <utility>

namespace towbench::harness {
namespace {

// A third-party image is idle when nothing has been driven and nothing typed for so long.
constexpr core::Nanoseconds kQuiet_ns = 300 * core::kNanosecondsPerMillisecond;
// Rows wait in the image at most for one long reply of its console.
constexpr std::size_t kDecodedKept = 4096;

}  // namespace

FirmwareBench::FirmwareBench(board::Board& board, const BoardWiring& wiring, std::uint8_t axes_mask,
                             std::uint64_t rig_hash, const FirmwareMachine& machine,
                             FirmwareRecorder& recorder)
    : board_(board),
      wiring_(wiring),
      plant_(machine.plant),
      truth_(machine.truth),
      rows_(machine.rows),
      recorder_(recorder),
      node_(board, wiring, axes_mask, rig_hash),
      duty_watch_(&recorder),
      to_plant_(duty_watch_, plant_.sink()),
      probe_(board) {
  plant_.connect(node_);
  node_.connect(to_plant_);
  if (!probe_.has_port()) {
    truth_.keep_from(0);  // as the rows of the pins
  }
}

core::Status FirmwareBench::start() noexcept {
  node_.greet();
  auto status = plant_.wait_for(protocol::Turn::kHelloReply);
  if (status) {
    status = node_.handshake();
  }
  if (!status) {
    return status;
  }
  to_plant_.on(protocol::Advance{now_ns_});
  return plant_.wait_for(protocol::Turn::kAdvanced);
}

std::string_view FirmwareBench::serve() {
  board_.run_until(now_ns_);
  node_.send_outputs();
  if (node_.drives()) {
    driven_last_ns_ = now_ns_;
  }
  take_records();
  return console_;
}

core::Status FirmwareBench::advance() noexcept {
  const core::Nanoseconds until_ns = now_ns_ + core::kPlantTick_ns;
  to_plant_.on(protocol::Advance{until_ns});
  auto status = plant_.wait_for(protocol::Turn::kAdvanced);
  if (status && node_.plant_time_ns() != until_ns) {
    status = core::failure(core::ErrorCode::kTimeNotMonotonic);
  }
  if (status) {
    now_ns_ = until_ns;
  }
  return status;
}

void FirmwareBench::finish() {
  node_.say_bye();
  static_cast<void>(plant_.wait_for(protocol::Turn::kBye));
  take_records();
}

void FirmwareBench::type(std::string_view bytes) {
  if (!bytes.empty()) {
    board_.uart().type(bytes);
    typed_last_ns_ = now_ns_;
  }
}

bool FirmwareBench::idle() const noexcept {
  const bool typing = board_.uart().has_input();
  if (probe_.has_port()) {
    return !typing && probe_.idle();
  }
  return !typing && now_ns_ - driven_last_ns_ >= kQuiet_ns && now_ns_ - typed_last_ns_ >= kQuiet_ns;
}

std::string FirmwareBench::failure() const {
  return board_.verdict() ? board_.verdict()->sentence : std::string{};
}

void FirmwareBench::take_records() {
  Decoded now{.time_ns = now_ns_, .edges = {}};
  for (const core::Axis axis : core::kPlanarAxes) {
    now.edges[axis] = board_.encoder(wiring_.axes[axis].encoder).edges_decoded();
  }
  decoded_.push_back(now);
  if (decoded_.size() > kDecodedKept) {
    decoded_.pop_front();
  }
  console_ = board_.uart().take_sent();
  recorder_.console(console_);
  if (probe_.has_port()) {
    take_rows();
  } else if (now_ns_ >= next_pin_row_ns_) {
    next_pin_row_ns_ += kPinRow_ns;  // the last moment of a run is looked at twice
    write_pin_row();
  }
}

const FirmwareBench::Decoded& FirmwareBench::decoded_at(core::Nanoseconds time_ns) const {
  const core::Nanoseconds ago = (decoded_.back().time_ns - time_ns) / core::kPlantTick_ns;
  const auto back = static_cast<std::size_t>(ago < 0 ? 0 : ago);
  return back < decoded_.size() ? decoded_[decoded_.size() - 1 - back] : decoded_.front();
}

void FirmwareBench::write_pin_row() {
  PinRow row;
  row.time_ns = now_ns_;
  for (const core::Axis axis : core::kPlanarAxes) {
    const std::uint64_t edges = decoded_.back().edges[axis];
    row.axes[axis] = {.count = board_.encoder(wiring_.axes[axis].encoder).count(),
                      .duty_pct = node_.duty_pct(axis),
                      .edges = static_cast<std::uint32_t>(edges - edges_told_[axis])};
    edges_told_[axis] = edges;
  }
  recorder_.pins(row);
}

// The image counts time from the start of its own timer. Its first row is written down at the
// exchange in which it came; the others follow at the image's own distances.
void FirmwareBench::take_rows() {
  bbmc::TelemetryRow row;
  while (probe_.next_row(row)) {
    if (!row_seen_) {
      row_seen_ = true;
      row_offset_ns_ = now_ns_ - row.time_ns;
      truth_.keep_from(now_ns_);
    }
    row.time_ns += row_offset_ns_;
    const Decoded& decoded = decoded_at(row.time_ns);
    for (const core::Axis axis : core::kPlanarAxes) {
      // What the decoder of the board has counted: the image sees positions, not edges.
      row.axes[axis].edges = static_cast<std::uint32_t>(decoded.edges[axis] - edges_told_[axis]);
      edges_told_[axis] = decoded.edges[axis];
    }
    recorder_.row(row);
    if (rows_ != nullptr) {
      rows_->log.push_back(row);
    }
  }
  bbmc::SystemEvent event;
  while (probe_.next_event(event)) {
    event.time_ns += row_offset_ns_;
    recorder_.event(event);
    if (rows_ != nullptr) {
      rows_->controller_events.push_back(event);
    }
  }
}

}  // namespace towbench::harness
