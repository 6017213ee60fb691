// When the encoders' last edges came, from the messages that reach a controller: what shows its
// speed to those who observe the run.
#pragma once

#include "bbmc/host/quadrature_decoder.h"
#include "core/axis.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class EdgeWatch final : public protocol::MessageSink {
 public:
  using MessageSink::on;
  // A message that was lost is no matter here: the next one begins anew.
  void on(const protocol::EncoderReport& report) noexcept override {
    (void)decoders_[report.axis].take(report);
  }
  void on(const protocol::EncoderEdges& edges) noexcept override {
    (void)decoders_[edges.axis].take(edges);
  }

  [[nodiscard]] core::PerAxis<bbmc::EdgeTimes> times() const noexcept {
    core::PerAxis<bbmc::EdgeTimes> times;
    for (const auto which : core::kAllAxes) {
      times[which] = decoders_[which].edge_times();
    }
    return times;
  }

 private:
  core::PerAxis<bbmc::QuadratureDecoder> decoders_;
};

}  // namespace towbench::harness
