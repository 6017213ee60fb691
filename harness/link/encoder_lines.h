// A run whose encoders are real lines, edge by edge, while everything else goes over its carrier.
//
// Plant's side: asks the plant for its edges, whatever the controller can take over the carrier,
// and drives the lines in the edges' order, all of an exchange (by the wall clock: of a tick) in
// one burst. Controller's side: counts what the lines did and reports it each exchange, as the
// digest (EncoderReport) of a peripheral that stands on this side.
//
// In lockstep an edge's place in the order counts and its time does not: what moved is dated to the
// exchange's end, and the capture period is the mean since the exchange before in which something
// moved. The plant's own count crosses the carrier too; it
// tells how long to wait for edges that the kernel has not handed out yet, and a count that stays
// different is a loss. The controller never sees it. By the wall clock only the lines tell: times
// and capture period are the kernel's.
#pragma once

#include <array>
#include <cstdint>

#include "core/axis.h"
#include "harness/link/line_count.h"
#include "harness/link/plant_end.h"
#include "protocol/carriers/edge_port.h"
#include "protocol/each_message.h"

namespace towbench::harness {

enum class EdgeTimes : std::uint8_t { kOfExchange, kOfKernel };

class EncoderLinesAtController final : public PlantEnd {
 public:
  // So long edges may take from the machine's side to ours in lockstep, by the reader's clock.
  static constexpr core::Nanoseconds kEdgeLimit_ns = core::kNanosecondsPerSecond;

  // Both outlive this.
  EncoderLinesAtController(PlantEnd& plant, protocol::EdgeReader& reader, EdgeTimes times) noexcept
      : plant_(plant), reader_(reader), times_(times) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    to_controller_.to = &controller;
    plant_.connect(to_controller_);
  }
  // kSequence when an edge was lost, kProtocolCapabilities when the plant sends its encoders over
  // the carrier as if there were no lines.
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(EncoderLinesAtController& the_owner) noexcept : owner(the_owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      owner.plant_.sink().on(message);
    }
    void handle(const protocol::Hello& hello) noexcept;
    void handle(const protocol::Advance& advance) noexcept;
    EncoderLinesAtController& owner;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    explicit ToController(EncoderLinesAtController& the_owner) noexcept : owner(the_owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to->on(message);
    }
    void handle(const protocol::EncoderEdges& edges) noexcept;
    void handle(const protocol::EncoderReport& report) noexcept;
    EncoderLinesAtController& owner;
    protocol::MessageSink* to = nullptr;
  };
  struct Encoder {
    LineCount lines;
    std::int32_t told_count = 0;  // by the plant, since the start
    std::uint16_t told_pulses = 0;
    protocol::EncoderReport report;  // the last one
    std::int32_t reported_count = 0;
    std::uint16_t reported_pulses = 0;
    core::Nanoseconds edge_ns = 0;  // of A or B, by the reader's clock
    core::Nanoseconds edge_before_ns = 0;
  };

  core::Status start() noexcept;
  core::Status gather() noexcept;
  [[nodiscard]] bool has_all_that_was_told() const noexcept;
  void take(const protocol::LineEdge& edge) noexcept;
  void report(core::Axis axis) noexcept;

  PlantEnd& plant_;
  protocol::EdgeReader& reader_;
  EdgeTimes times_;
  ToPlant to_plant_{*this};
  ToController to_controller_{*this};
  core::PerPlanarAxis<Encoder> encoders_;
  core::Status status_;
  core::Nanoseconds until_ns_ = 0;
  core::Nanoseconds start_ns_ = 0;  // of the run, by the reader's clock
  std::uint8_t axes_mask_ = 0;
  bool started_ = false;
};

// Stands on both ways of the plant, as RealLinesAtPlant does.
class EncoderLinesAtPlant {
 public:
  // All outlive this. `start_levels`: of the encoders before the first step. `tells_count`: in
  // lockstep.
  EncoderLinesAtPlant(protocol::MessageSink& plant, protocol::MessageSink& controller,
                      protocol::EdgeDriver& driver,
                      const core::PerPlanarAxis<protocol::EncoderLevels>& start_levels,
                      bool tells_count) noexcept;

  [[nodiscard]] protocol::MessageSink& from_controller() noexcept { return in_; }
  [[nodiscard]] protocol::MessageSink& to_controller() noexcept { return out_; }
  // The first failure of the lines.
  [[nodiscard]] core::Status status() const noexcept { return status_; }

 private:
  struct In final : protocol::EachMessage<In> {
    explicit In(protocol::MessageSink& plant) noexcept : to(plant) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::Hello& hello) noexcept;
    protocol::MessageSink& to;
  };
  struct Out final : protocol::EachMessage<Out> {
    Out(EncoderLinesAtPlant& the_owner, protocol::MessageSink& controller) noexcept
        : owner(the_owner), to(controller) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::EncoderEdges& edges) noexcept;
    void handle(const protocol::Advanced& advanced) noexcept;
    EncoderLinesAtPlant& owner;
    protocol::MessageSink& to;
  };
  struct Encoder {
    LineCount lines;
    protocol::EncoderReport report;
    std::int32_t told_count = 0;
    std::uint16_t told_pulses = 0;
    bool is_there = false;
  };

  void toggle(core::Axis axis, protocol::EncoderLine line) noexcept;
  void adopt(core::Axis axis, protocol::EncoderLevels levels) noexcept;
  void tell(core::Axis axis, core::Nanoseconds now_ns) noexcept;

  In in_;
  Out out_;
  protocol::EdgeDriver& driver_;
  bool tells_count_;
  core::PerPlanarAxis<Encoder> encoders_;
  core::Status status_;
};

}  // namespace towbench::harness
