// What EXP-1 shows: Tables 8.2, 8.3 and 8.4, drag curves, friction by place.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/identify/tow/drive_scale.h"
#include "study/identify/tow/extended_model.h"
#include "study/identify/tow/rigid_model.h"
#include "study/procedures/figure.h"
#include "study/procedures/machine.h"

namespace towbench::study::procedures {

[[nodiscard]] identify::Estimate scale_estimate(const identify::DriveScale& scale,
                                                const Machine& machine);
[[nodiscard]] Curve curve_of(const std::string& name, std::span<const identify::DragPoint> points);
[[nodiscard]] Figure friction_figure(const identify::RigidModel& near,
                                     const identify::RigidModel& middle,
                                     const identify::ExtendedModel& extended);
// Table 8.2, at the motor.
[[nodiscard]] ResultTable model_table(const identify::RigidModel& near,
                                      const identify::RigidModel& middle, const Machine& machine);
// Table 8.3, without and with the object in the water.
[[nodiscard]] ResultTable tracking_table(const std::vector<identify::Recording>& out,
                                         const std::vector<identify::Recording>& in);
// Table 8.4.
[[nodiscard]] ResultTable drag_table(const identify::Estimates& estimates);

}  // namespace towbench::study::procedures
