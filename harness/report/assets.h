// The page's template, style sheet and script, embedded at build time (cmake/report_assets.cmake).
#pragma once

#include <string_view>

namespace towbench::harness::report {

struct Asset {
  std::string_view text;
  std::string_view sha256_hex;  // of exactly `text`: the page's security policy names it
};

[[nodiscard]] Asset template_asset();
[[nodiscard]] Asset style_asset();
// Empty in a build with TOWBENCH_REPORT_ASSETS=OFF.
[[nodiscard]] Asset script_asset();

}  // namespace towbench::harness::report
