// A PlantObserver that hands everything on. Whoever alters one kind overrides that one.
#pragma once

#include "emulator/plant_node.h"

namespace towbench::emulator {

class PlantRelay : public PlantObserver {
 public:
  // `to` outlives this.
  explicit PlantRelay(PlantObserver& to) noexcept : to_(to) {}

  void on_truth(const TruthRow& row) noexcept override { to_.on_truth(row); }
  void on_event(const PlantEvent& event) noexcept override { to_.on_event(event); }
  void on_frame(const CameraFrame& frame) noexcept override { to_.on_frame(frame); }
  void on_force(const protocol::ForceSample& sample) noexcept override { to_.on_force(sample); }
  void on_current(const protocol::CurrentSample& sample) noexcept override {
    to_.on_current(sample);
  }
  void on_refusal(const protocol::Hello& ours, const protocol::Hello& theirs,
                  core::ErrorCode why) noexcept override {
    to_.on_refusal(ours, theirs, why);
  }

 private:
  PlantObserver& to_;
};

}  // namespace towbench::emulator
