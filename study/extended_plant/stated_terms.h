// What a plant file states beyond mass, friction and transmission, as the axis that predicts has
// it: the inverse of what the registry of causes writes into a plant file.
#pragma once

#include "core/axis.h"
#include "emulator/rig_parameters.h"
#include "study/prediction/nominal_model.h"

namespace towbench::study::diagnose {

// `model` has the four parameters and the transmission already. Warming by its own work is left
// out: its size depends on the motion.
void add_stated_terms(const emulator::RigParameters& machine, core::Axis which,
                      NominalModel& model);

}  // namespace towbench::study::diagnose
