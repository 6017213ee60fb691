// The two axes that this controller drives.
#pragma once

#include "core/axis.h"

namespace towbench::bbmc {

inline constexpr auto& kAxes = core::kPlanarAxes;
inline constexpr std::size_t kAxisCount = kAxes.size();

template <typename T>
using PerAxis = core::PerPlanarAxis<T>;

}  // namespace towbench::bbmc
