// EXP-1: what is towed where.
#pragma once

#include "study/procedures/tow/straight_tow.h"
#include "study/procedures/tow/weigh_drive.h"

namespace towbench::study::procedures {

// Tows in air from which a model is identified.
struct IdentificationSettings {
  StraightTowSettings near{0.08, 0.16, 0.24, 0.32};    // where the tows begin
  StraightTowSettings middle{0.08, 0.16, 0.24, 0.32};  // mid tank, as 7.2.1 did
  StraightTowSettings survey{0.08, 0.20, 0.40};        // all along the tows, for the extended model

  IdentificationSettings() noexcept {
    for (auto* each : {&near, &middle}) {
      each->distance_m = 1.0;
      each->acceleration_s = 0.4;
      each->settle_s = 0.8;
    }
    middle.start_m = 1.48;
  }

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("near", near, "rigid model, identified where the tows begin");
    v.group("middle", middle, "rigid model, identified in mid tank");
    v.group("survey", survey, "extended model");
  }
};

struct Exp1Settings {
  StraightTowSettings tows;
  WeighSettings weigh;
  IdentificationSettings identification;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.group("tows", tows, "in and out of the water");
    v.group("weigh", weigh, "the drive's scale by a known weight");
    v.group("identification", identification, "models for the prediction");
  }
};

}  // namespace towbench::study::procedures
