// The filter that identification and diagnosis share.
#pragma once

#include "study/identify/zero_phase_filter.h"

namespace towbench::harness::diagnose {

using identify::central_difference;
using identify::ZeroPhaseFilter;

}  // namespace towbench::harness::diagnose
