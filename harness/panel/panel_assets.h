// The panel's page, style sheet and script, embedded at build time (cmake/report_assets.cmake).
#pragma once

#include "harness/report/assets.h"

namespace towbench::harness::panel {

using report::Asset;

[[nodiscard]] Asset page_asset();
[[nodiscard]] Asset style_asset();
// Empty in a build with TOWBENCH_REPORT_ASSETS=OFF.
[[nodiscard]] Asset script_asset();

}  // namespace towbench::harness::panel
