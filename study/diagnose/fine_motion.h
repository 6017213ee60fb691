// A rigid axis' motion, finer than its encoder's steps.
//
// Differentiated twice the steps drown what is fast: at 40 Hz those of 445,345 counts a metre make
// 0.04 N of the nominal axis look like force, more than a chain of 50 Hz or a play of one count
// does. But what commands the axis is known: below a frequency this is what was measured, above it
// what the fitted rigid model makes of the input (complementary filters, Higgins 1975). A column
// made of it is free of the noise that the residual is made of.
#pragma once

#include <Eigen/Core>

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {

struct FineMotion {
  Eigen::VectorXd position_m;
  Eigen::VectorXd speed_m_per_s;
};

// Where the axis stands the command says nothing of its motion, and is taken for none.
[[nodiscard]] Eigen::VectorXd fine_acceleration_m_per_s2(const Signals& signals,
                                                         const Context& context);
[[nodiscard]] FineMotion fine_motion(const Signals& signals, const Context& context);

}  // namespace towbench::harness::diagnose
